// SPDX-License-Identifier: MIT
#include "tests/gl/stage.h"

namespace spindrift::gl
{

Context& test_context()
{
    static const std::unique_ptr<Context> context = make_headless_context();
    return *context;
}

}  // namespace spindrift::gl
