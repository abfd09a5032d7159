// SPDX-License-Identifier: MIT
#pragma once

// GLEW first: it stands in for the system's GL header, which the CUDA header asks for.
#include <GL/glew.h>
#include <cuda_gl_interop.h>

namespace spindrift::gpu
{

/// The calls of the CUDA runtime that deal with OpenGL. All of them belong into the thread whose GL context
/// is current. Tests put calls in their place that fail as drivers do.
struct GraphicsCalls
{
    cudaError_t (*devices)(unsigned*, int*, unsigned, cudaGLDeviceList) = cudaGLGetDevices;
    cudaError_t (*register_buffer)(cudaGraphicsResource**, GLuint, unsigned) = cudaGraphicsGLRegisterBuffer;
    cudaError_t (*unregister)(cudaGraphicsResource_t) = cudaGraphicsUnregisterResource;
    cudaError_t (*map)(int, cudaGraphicsResource_t*, cudaStream_t) = cudaGraphicsMapResources;
    cudaError_t (*unmap)(int, cudaGraphicsResource_t*, cudaStream_t) = cudaGraphicsUnmapResources;
    cudaError_t (*address)(void**, std::size_t*,
                           cudaGraphicsResource_t) = cudaGraphicsResourceGetMappedPointer;
};

}  // namespace spindrift::gpu
