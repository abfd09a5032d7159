# SPDX-License-Identifier: MIT
# What every target of the project shares: language, warnings, numerics, sanitizers.

add_library(spindrift_numerics INTERFACE)
# The same bits on every backend: contraction off, no errno from sqrt. Never any fast-math.
target_compile_options(spindrift_numerics INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-ffp-contract=off;-fno-math-errno>)
# CMake 3.25 does not know that nvcc speaks C++20.
target_compile_options(spindrift_numerics INTERFACE
    $<$<COMPILE_LANGUAGE:CUDA>:-std=c++20;--fmad=false;-Xcompiler=-ffp-contract=off,-fno-math-errno;--extended-lambda>)
target_compile_features(spindrift_numerics INTERFACE cxx_std_20)

add_library(spindrift_warnings INTERFACE)
target_compile_options(spindrift_warnings INTERFACE
    $<$<COMPILE_LANGUAGE:CXX>:-Wall;-Wextra;-Wshadow;-Wconversion;-Wno-sign-conversion;-Wnon-virtual-dtor;-Woverloaded-virtual;-Werror>
    $<$<COMPILE_LANGUAGE:CUDA>:-Werror=all-warnings;-Xcompiler=-Wall,-Wextra>)

if(SPINDRIFT_SANITIZE)
    add_compile_options(-fsanitize=${SPINDRIFT_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
    add_link_options(-fsanitize=${SPINDRIFT_SANITIZE})
endif()

# spindrift_library(<part> [SOURCES ...] [PUBLIC libs...] [PRIVATE libs...]): a static library spindrift_<part>,
# alias spindrift::<part>.
function(spindrift_library part)
    cmake_parse_arguments(arg "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
    add_library(spindrift_${part} STATIC ${arg_SOURCES})
    add_library(spindrift::${part} ALIAS spindrift_${part})
    set_property(GLOBAL APPEND PROPERTY SPINDRIFT_LIBRARIES spindrift_${part})
    set_target_properties(spindrift_${part} PROPERTIES EXPORT_NAME ${part} POSITION_INDEPENDENT_CODE ON)
    target_include_directories(spindrift_${part} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
    target_link_libraries(spindrift_${part} PUBLIC spindrift_numerics ${arg_PUBLIC}
                          PRIVATE $<BUILD_INTERFACE:spindrift_warnings> ${arg_PRIVATE})
endfunction()
