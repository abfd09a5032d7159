// SPDX-License-Identifier: MIT
#include "tests/app/child_process.h"

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <stdexcept>

#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace spindrift::test
{

namespace
{

struct Pipe
{
    int read_end = -1, write_end = -1;
};

Pipe make_pipe(bool terminal)
{
    Pipe made;
    if (terminal)
    {
        if (openpty(&made.read_end, &made.write_end, nullptr, nullptr, nullptr) != 0)
            throw std::runtime_error("openpty");
        return made;
    }
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("pipe");
    return {ends[0], ends[1]};
}

[[noreturn]] void become_command(const Launch& launch, const Pipe& out, const Pipe& err)
{
    if (launch.standard_output.empty())
        dup2(out.write_end, STDOUT_FILENO);
    else
        dup2(open(launch.standard_output.c_str(), O_WRONLY | O_CREAT, 0644), STDOUT_FILENO);
    dup2(err.write_end, STDERR_FILENO);
    for (int fd : {out.read_end, out.write_end, err.read_end, err.write_end}) close(fd);
    for (const std::string& name : launch.unset) unsetenv(name.c_str());
    for (const std::string& pair : launch.environment)
        setenv(pair.substr(0, pair.find('=')).c_str(), pair.substr(pair.find('=') + 1).c_str(), 1);
    if (launch.largest_file_bytes)
    {
        const rlimit limit = {*launch.largest_file_bytes, *launch.largest_file_bytes};
        setrlimit(RLIMIT_FSIZE, &limit);
        std::signal(SIGXFSZ, SIG_IGN);  // write() answers EFBIG instead
    }
    std::vector<char*> argv = {const_cast<char*>(SPINDRIFT_COMMAND)};
    for (const std::string& argument : launch.arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    execv(SPINDRIFT_COMMAND, argv.data());
    _exit(127);
}

bool has_ended(pid_t child)
{
    siginfo_t info = {};
    return waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOHANG | WNOWAIT) != 0 ||
           info.si_pid != 0;
}

/// Sends SIGINT when the file is there, or after two minutes; not to a command that has ended before.
void interrupt_when(const std::filesystem::path& file, pid_t child)
{
    constexpr useconds_t kPoll_us = 10000;
    for (int i = 0; i < 12000 && !std::filesystem::exists(file) && !has_ended(child); ++i) usleep(kPoll_us);
    if (!has_ended(child)) kill(child, SIGINT);
}

/// Reads both ends until both are closed. A pseudo terminal answers EIO when its other side is gone.
void drain(int out, int err, Finished& result)
{
    pollfd ends[2] = {{out, POLLIN, 0}, {err, POLLIN, 0}};
    std::string* texts[2] = {&result.output, &result.error};
    int open_ends = 2;
    while (open_ends > 0)
    {
        if (poll(ends, 2, -1) < 0 && errno != EINTR) throw std::runtime_error("poll");
        for (int i = 0; i < 2; ++i)
        {
            if (ends[i].fd < 0 || ends[i].revents == 0) continue;
            char buffer[4096];
            const ssize_t n = read(ends[i].fd, buffer, sizeof buffer);
            if (n > 0)
                texts[i]->append(buffer, static_cast<std::size_t>(n));
            else
                ends[i].fd = -1, --open_ends;
        }
    }
}

}  // namespace

Finished run_command(const Launch& launch)
{
    const Pipe out = make_pipe(false);
    const Pipe err = make_pipe(launch.error_on_terminal);
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("fork");
    if (child == 0) become_command(launch, out, err);
    close(out.write_end);
    close(err.write_end);
    if (!launch.interrupt_when_there_is.empty()) interrupt_when(launch.interrupt_when_there_is, child);
    Finished result;
    drain(out.read_end, err.read_end, result);
    close(out.read_end);
    close(err.read_end);
    int status = 0;
    waitpid(child, &status, 0);
    result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return result;
}

Finished run_command(const std::vector<std::string>& arguments)
{
    Launch launch;
    launch.arguments = arguments;
    return run_command(launch);
}

}  // namespace spindrift::test
