// The headers of POSIX systems, for the checks of what only those have: signals, limits, pipes, terminals.
#pragma once

#if !defined(_WIN32)
#include <csignal>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>
#endif
#if defined(__linux__)
#include <sched.h>
#endif
