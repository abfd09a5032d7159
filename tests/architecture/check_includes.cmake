# SPDX-License-Identifier: MIT
cmake_minimum_required(VERSION 3.25)
# cmake -D ROOT=<folder of the parts> -P check_includes.cmake
# Fails, naming each line, if a part includes what the table of docs/architecture.md does not allow it.

set(parts core image scene cpu gl reference app bench include)

# The parts whose headers a part may include.
set(core_may core)
set(image_may core image)
set(scene_may core scene)
set(cpu_may core cpu)
set(gl_may core image scene gl)
set(reference_may core image scene reference)
set(include_may core spindrift)
set(app_may core image scene cpu gl reference app spindrift)
set(bench_may core image scene cpu gl reference bench)

# Headers from outside that a part must not include: core is physics and plain data, scene plain data from files, and
# only gl draws. The numbers of core come from its own polynomials, never from libm.
set(graphics "GL/|GLFW/|EGL/|cuda|imgui")
set(threads "tbb/|oneapi/|thread>|mutex>|atomic>|future>|execution>|condition_variable>")
set(core_never "${graphics}|${threads}|fstream>|iostream>|cstdio>|filesystem>|cmath>|math\\.h>|random>")
set(scene_never "${graphics}|${threads}")
set(image_never "${graphics}")
set(cpu_never "${graphics}")
set(reference_never "${graphics}")

set(faults "")
foreach(part IN LISTS parts)
    file(GLOB_RECURSE files RELATIVE ${ROOT} ${ROOT}/${part}/*.h ${ROOT}/${part}/*.cpp ${ROOT}/${part}/*.inl)
    foreach(file IN LISTS files)
        file(STRINGS ${ROOT}/${file} includes REGEX "^[ \t]*#[ \t]*include")
        foreach(line IN LISTS includes)
            if(line MATCHES "[<\"](core|image|scene|cpu|gl|reference|app|bench|tests|spindrift)/" AND
               NOT CMAKE_MATCH_1 IN_LIST ${part}_may)
                list(APPEND faults "${file}: ${line} (${part} may use: ${${part}_may})")
            elseif(DEFINED ${part}_never AND line MATCHES "<(${${part}_never})")
                list(APPEND faults "${file}: ${line} (never in ${part})")
            endif()
        endforeach()
    endforeach()
endforeach()

if(faults)
    list(JOIN faults "\n" faults)
    message(FATAL_ERROR "Forbidden includes; docs/architecture.md says which part may know which:\n${faults}")
endif()
