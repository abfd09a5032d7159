// SPDX-License-Identifier: MIT
#include "gl/pass_timers.h"

namespace spindrift::gl
{

void PassTimers::collect(const Frame& frame)
{
    if (frame.names.empty()) return;
    GLint ready = GL_FALSE;
    glGetQueryObjectiv(frame.queries[frame.names.size() - 1].name(), GL_QUERY_RESULT_AVAILABLE, &ready);
    if (ready == GL_FALSE) return;
    times_.clear();
    for (std::size_t i = 0; i < frame.names.size(); ++i)
    {
        GLuint64 ns = 0;
        glGetQueryObjectui64v(frame.queries[i].name(), GL_QUERY_RESULT, &ns);
        times_.push_back({frame.names[i], static_cast<double>(ns) * 1e-6});
    }
}

void PassTimers::begin_frame()
{
    current_ ^= 1;
    collect(frames_[current_]);
    frames_[current_].names.clear();
}

void PassTimers::begin(std::string_view pass)
{
    Frame& frame = frames_[current_];
    if (frame.names.size() == frame.queries.size()) frame.queries.push_back(make_query(GL_TIME_ELAPSED));
    frame.names.emplace_back(pass);
    glBeginQuery(GL_TIME_ELAPSED, frame.queries[frame.names.size() - 1].name());
}

void PassTimers::end()
{
    glEndQuery(GL_TIME_ELAPSED);
}

}  // namespace spindrift::gl
