// SPDX-License-Identifier: MIT
#include "scene/try_in_child.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

namespace spindrift::scene
{

namespace
{

[[noreturn]] void run_child(const std::function<void()>& function, unsigned limit_s)
{
    for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGALRM, SIGTERM})
        std::signal(signal, SIG_DFL);
    std::signal(SIGINT, SIG_IGN);  // Ctrl-C is for the parent
    const rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    if (const int nowhere = open("/dev/null", O_WRONLY); nowhere >= 0)
    {
        dup2(nowhere, STDOUT_FILENO);
        dup2(nowhere, STDERR_FILENO);
    }
    alarm(limit_s);
    try
    {
        function();
    }
    catch (...)  // the parent meets the same exception and reports it
    {
    }
    _exit(0);
}

}  // namespace

ChildFate try_in_child(const std::function<void()>& function, unsigned limit_s)
{
    const pid_t child = fork();
    if (child < 0) return ChildFate::returned;
    if (child == 0) run_child(function, limit_s);
    int status = 0;
    while (waitpid(child, &status, 0) < 0)
        if (errno != EINTR) return ChildFate::returned;
    if (WIFEXITED(status)) return WEXITSTATUS(status) == 0 ? ChildFate::returned : ChildFate::crashed;
    return WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM ? ChildFate::took_too_long : ChildFate::crashed;
}

}  // namespace spindrift::scene
