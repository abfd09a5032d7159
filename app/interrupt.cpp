// SPDX-License-Identifier: MIT
#include "app/interrupt.h"

#include <csignal>

namespace spindrift::app
{

namespace
{

volatile std::sig_atomic_t g_requested = 0;

void note(int)
{
    g_requested = 1;
}

void handle(int signal, void (*handler)(int), int flags)
{
    struct sigaction action = {};
    action.sa_handler = handler;
    action.sa_flags = flags;
    sigemptyset(&action.sa_mask);
    sigaction(signal, &action, nullptr);
}

}  // namespace

InterruptWatch::InterruptWatch()
{
    g_requested = 0;
    handle(SIGINT, note, static_cast<int>(SA_RESETHAND) | SA_RESTART);
    handle(SIGTERM, note, static_cast<int>(SA_RESETHAND) | SA_RESTART);
    handle(SIGPIPE, SIG_IGN, 0);
}

InterruptWatch::~InterruptWatch()
{
    handle(SIGINT, SIG_DFL, 0);
    handle(SIGTERM, SIG_DFL, 0);
    handle(SIGPIPE, SIG_DFL, 0);
}

bool InterruptWatch::requested() const
{
    return g_requested != 0;
}

}  // namespace spindrift::app
