// What programs ask of the operating system. Implemented once for each: system_posix.cpp and system_windows.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace rt {

#if defined(_WIN32)
inline constexpr const char* program_ending = ".exe";
inline constexpr char list_separator = ';'; ///< between the folders in PATH
#else
inline constexpr const char* program_ending = "";
inline constexpr char list_separator = ':';
#endif

/// Prepares stdin, stdout and stderr. A closed one is opened on nothing: otherwise the next file opened would get its
/// number, and text for the terminal would end up in an image. A failing write is an error and does not kill the program.
/// Text is UTF-8, and lines end with \n on every system.
void prepare_streams();

/// Returns whether a stream is a terminal. 0: stdin, 1: stdout, 2: stderr.
bool is_terminal(int stream);

/// Returns the width of the terminal behind stdout (1) or stderr (2) in columns; 0 if there is none.
int terminal_columns(int stream);

/// Prints on stderr. May be called in a signal handler.
void print_in_handler(const char* text) noexcept;

/// Returns how many cores the affinity mask of this process allows; 0 if unknown.
int cores_of_affinity();

/// Returns how many bytes of memory this process may use: the machine's, or less by `ulimit -v`; 0 if unknown.
std::int64_t usable_memory();

/// Asks for huge pages behind this memory, whose size and address are multiples of 2 MB. The system may refuse.
void use_huge_pages(void* memory, std::size_t bytes) noexcept;

/// Ends this process once it has used that many more seconds of processor time. A later call replaces the limit.
void limit_processor_time(int seconds);

/// Sets an environment variable for this process and those that it starts. An empty value removes it.
void set_environment(const std::string& name, const std::string& value);

} // namespace rt
