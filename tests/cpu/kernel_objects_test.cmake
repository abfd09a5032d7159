# SPDX-License-Identifier: MIT
# Fails if an object file of OBJECTS defines a symbol that the linker may merge with another unit's (weak or unique).
if(NOT OBJECTS)
    message(FATAL_ERROR "no kernel objects were given")
endif()
foreach(object IN LISTS OBJECTS)
    execute_process(COMMAND ${NM} --defined-only ${object} OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
    string(REGEX MATCHALL "[^\n]* [WVuv] [^\n]*" shared "${symbols}")
    if(shared)
        message(FATAL_ERROR "${object} shares code with other units: ${shared}; make it always_inline or local")
    endif()
endforeach()
