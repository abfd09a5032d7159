// SPDX-License-Identifier: MIT
#include "cuda/late_control.h"

namespace spindrift::gpu
{

LateControl::LateControl() : copies_(kSlots) {}

void LateControl::ask(StreamRef stream, const StepControl* device)
{
    const std::size_t s = ++asked_ % kSlots;
    copy_to_host(stream, &copies_[s], device, 1);
    arrived_[s].record(stream);
}

const StepControl& LateControl::newest()
{
    // A slot that a later copy may be written to has an event that is not done, so it is not read.
    for (std::size_t back = 0; back < kSlots && asked_ - back > known_asked_; ++back)
    {
        const std::size_t s = (asked_ - back) % kSlots;
        if (!arrived_[s].is_done()) continue;
        known_ = copies_[s];
        known_asked_ = asked_ - back;
        break;
    }
    return known_;
}

const StepControl& LateControl::wait()
{
    if (asked_ > known_asked_) arrived_[asked_ % kSlots].wait();
    return newest();
}

void LateControl::set(const StepControl& known)
{
    known_ = known;
    known_asked_ = asked_;
}

}  // namespace spindrift::gpu
