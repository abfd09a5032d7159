// SPDX-License-Identifier: MIT
#include "gl/debug_log.h"

#include <GL/glew.h>

#include <mutex>

namespace spindrift::gl
{

namespace
{

// Drivers may call back from threads of their own.
std::mutex log_mutex;
std::string log_text;

bool is_error(GLenum type)
{
    return type == GL_DEBUG_TYPE_ERROR || type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR ||
           type == GL_DEBUG_TYPE_PORTABILITY;
}

void GLAPIENTRY keep_message(GLenum, GLenum type, GLuint, GLenum, GLsizei, const GLchar* message, const void*)
{
    if (!is_error(type)) return;
    const std::scoped_lock lock(log_mutex);
    log_text += message;
    log_text += '\n';
}

}  // namespace

void start_debug_log()
{
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(keep_message, nullptr);
}

std::string debug_log()
{
    const std::scoped_lock lock(log_mutex);
    return log_text;
}

}  // namespace spindrift::gl
