// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "gl/object.h"
#include "gl/program.h"

namespace spindrift::gl
{

/// One triangle over the whole target.
class FullScreenPass
{
  public:
    FullScreenPass(std::string_view vertex_file, std::string_view fragment_file);
    void draw() const;

  private:
    Program program_;
    VertexArray nothing_;
};

}  // namespace spindrift::gl
