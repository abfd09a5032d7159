# SPDX-License-Identifier: MIT
cmake_minimum_required(VERSION 3.25)
# cmake -D ROOT=<folder of the parts> -P check_includes.cmake
# Fails, naming each line, if a part includes what the table of docs/architecture.md does not allow it.

set(parts core image scene cpu cuda gl reference measure validation app bench include)

# The parts whose headers a part may include.
set(core_may core)
set(image_may core image)
set(scene_may core scene)
set(cpu_may core cpu)
# cuda/interop is the only place that names both CUDA and GL.
set(cuda_may core cuda)
set(interop_may core cuda gl)
set(gl_may core image scene gl)
set(reference_may core image scene reference)
set(include_may core spindrift)
set(measure_may core cpu cuda measure)
set(validation_may core scene cpu validation)
set(app_may core image scene cpu cuda gl reference measure validation app spindrift)
set(bench_may core image scene cpu cuda gl reference measure validation bench)

# Headers from outside that a part must not include: core is physics and plain data, scene plain data from files, and
# only gl draws. The numbers of core come from its own polynomials, never from libm.
set(graphics "GL/|GLFW/|EGL/|cuda_|cub/|thrust/|imgui")
set(threads "tbb/|oneapi/|thread>|mutex>|atomic>|future>|execution>|condition_variable>")
set(core_never "${graphics}|${threads}|fstream>|iostream>|cstdio>|filesystem>|cmath>|math\\.h>|random>")
set(scene_never "${graphics}|${threads}")
set(image_never "${graphics}")
set(cpu_never "${graphics}")
set(validation_never "${graphics}")
set(reference_never "${graphics}")
set(gl_never "cuda|cub/|thrust/")
set(cuda_never "GL/|GLFW/|EGL/|cuda_gl_interop|imgui")

set(faults "")
foreach(part IN LISTS parts)
    file(GLOB_RECURSE files RELATIVE ${ROOT} ${ROOT}/${part}/*.h ${ROOT}/${part}/*.cpp ${ROOT}/${part}/*.inl
         ${ROOT}/${part}/*.cu ${ROOT}/${part}/*.cuh)
    foreach(file IN LISTS files)
        set(rules ${part})
        if(file MATCHES "^cuda/interop/")
            set(rules interop)
        endif()
        file(STRINGS ${ROOT}/${file} includes REGEX "^[ \t]*#[ \t]*include")
        foreach(line IN LISTS includes)
            if(line MATCHES "[<\"](core|image|scene|cpu|cuda|gl|reference|measure|validation|app|bench|tests|spindrift)/" AND
               NOT CMAKE_MATCH_1 IN_LIST ${rules}_may)
                list(APPEND faults "${file}: ${line} (${rules} may use: ${${rules}_may})")
            elseif(DEFINED ${rules}_never AND line MATCHES "<(${${rules}_never})")
                list(APPEND faults "${file}: ${line} (never in ${rules})")
            endif()
        endforeach()
    endforeach()
endforeach()

if(faults)
    list(JOIN faults "\n" faults)
    message(FATAL_ERROR "Forbidden includes; docs/architecture.md says which part may know which:\n${faults}")
endif()
