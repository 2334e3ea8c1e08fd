// The figures that explain: each declares its options, and draws what the lesson's own functions answer.
#pragma once

namespace rt {

/// Each parses a command line and shows one drawing.
void camera(int argc, const char* const* argv);
void sphere_roots(int argc, const char* const* argv);
void lamp(int argc, const char* const* argv);
void snell(int argc, const char* const* argv);
void split(int argc, const char* const* argv);
void texels(int argc, const char* const* argv);
void samples(int argc, const char* const* argv);
void lens(int argc, const char* const* argv);

} // namespace rt
