// Included by the compiler in front of a check or program that made a NaN and runs once more: prints the stack at each
// operation that makes a NaN, such as 0 / 0 or the root of a negative number, and goes on. Only for Linux on x86-64.
#pragma once

#if defined(__linux__) && defined(__x86_64__)

#include <sanitizer/common_interface_defs.h>

#include <cfenv>
#include <csignal>
#include <ucontext.h>

namespace rt::nan_trap {

constexpr unsigned trap_mask = FE_INVALID << 7; // in the register MXCSR, beside the flags of <cfenv>
constexpr int single_step = 0x100;              // in EFLAGS: stops after each instruction

inline mcontext_t& registers(void* context) {
    return static_cast<ucontext_t*>(context)->uc_mcontext;
}

/// Before an operation that makes a NaN. It is carried out, without the trap, and stops after it. Other signals, which
/// doctest passes on, are ignored.
inline void show(int, siginfo_t* info, void* context) {
    if (info->si_code != FPE_FLTINV) return;
    static int shown = 0;
    if (++shown < 100) __sanitizer_print_stack_trace();
    registers(context).fpregs->mxcsr |= trap_mask;
    registers(context).gregs[REG_EFL] |= single_step;
}

/// After it.
inline void go_on(int, siginfo_t*, void* context) {
    registers(context).fpregs->mxcsr &= ~(trap_mask | FE_INVALID);
    registers(context).gregs[REG_EFL] &= ~single_step;
}

inline const int installed = [] {
    struct sigaction action {};
    action.sa_flags = SA_SIGINFO;
    action.sa_sigaction = show;
    sigaction(SIGFPE, &action, nullptr);
    action.sa_sigaction = go_on;
    sigaction(SIGTRAP, &action, nullptr);
    return feenableexcept(FE_INVALID);
}();

} // namespace rt::nan_trap

#endif
