# What tests, benches and examples share: warnings, arithmetic, ccache, and a function for each kind of program.
option(GNOMON_NATIVE "Compile tests, benches and examples for this machine's instruction set" ON)
string(FIND "${CMAKE_CXX_FLAGS}" "-fno-exceptions" flag)
string(COMPARE EQUAL ${flag} -1 GNOMON_EXCEPTIONS)

set(CMAKE_CXX_EXTENSIONS OFF)

find_program(GNOMON_CCACHE ccache)
if(GNOMON_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    # The words that let ccache take part in precompiled headers.
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${GNOMON_CCACHE})
    add_compile_options("$<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>"
        "$<$<CXX_COMPILER_ID:Clang>:SHELL:-Xclang -fno-pch-timestamp>")
endif()

add_library(gnomon_strict INTERFACE)
target_link_libraries(gnomon_strict INTERFACE gnomon::bit_exact)
target_compile_options(gnomon_strict INTERFACE
    -Wall -Wextra -Wconversion -Wdouble-promotion -Werror
    $<$<NOT:$<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>>:-Wshadow> # names of another file are shadowed in a unit of many
    # GCC bug 105593: the AVX-512 intrinsics warn of their own undefined operands.
    $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-uninitialized;-Wno-maybe-uninitialized>
    $<$<BOOL:${GNOMON_NATIVE}>:-march=native>)

# Linked after gnomon_strict, whose word on contraction it takes back: the arithmetic that a user gets without gnomon::bit_exact.
add_library(gnomon_contracted INTERFACE)
target_compile_options(gnomon_contracted INTERFACE $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-ffp-contract=fast>)

find_package(xsimd REQUIRED)
set_target_properties(xsimd PROPERTIES IMPORTED_GLOBAL TRUE INTERFACE_LINK_LIBRARIES "") # Debian's names xtl, unneeded and absent

# A doctest program and its ctest entry; the labels are those of docs/testing.md:
#   gnomon_test(NAME hamburger4 LABELS unit SOURCES a.cpp b.cpp [LIBRARIES gnomon_renderer])
# Label unit: quick, and built and run by the sanitizers, by clang and without exceptions too.
function(gnomon_test)
    cmake_parse_arguments(PARSE_ARGV 0 test "" "NAME" "LABELS;SOURCES;LIBRARIES")
    if(NOT GNOMON_EXCEPTIONS AND NOT test_LABELS STREQUAL "unit")
        return() # RapidCheck and the oracles need exceptions
    endif()
    add_executable(test_${test_NAME} ${test_SOURCES})
    target_link_libraries(test_${test_NAME} PRIVATE gnomon_doctest ${test_LIBRARIES})
    if(GNOMON_EXCEPTIONS)
        target_precompile_headers(test_${test_NAME} REUSE_FROM gnomon_doctest)
    endif()
    # From where the compiler runs, since __FILE__, by which tests find tables in docs/, may be relative to it.
    add_test(NAME ${test_NAME} COMMAND test_${test_NAME} WORKING_DIRECTORY ${PROJECT_BINARY_DIR})
    set_tests_properties(${test_NAME} PROPERTIES LABELS "${test_LABELS}")
    if("unit" IN_LIST test_LABELS)
        add_dependencies(gnomon_unit_tests test_${test_NAME})
    endif()
endfunction()

# The test that a target's sources compile: bench_compiles(NAME TARGET SOURCE...)
function(bench_compiles name target)
    set(definitions $<TARGET_PROPERTY:${target},COMPILE_DEFINITIONS>)
    if(GNOMON_BUILD_TESTS AND ARGN)
        add_test(NAME bench/${name} COMMAND ${CMAKE_CXX_COMPILER} -std=c++20 -fsyntax-only
            "-I$<JOIN:$<TARGET_PROPERTY:${target},INCLUDE_DIRECTORIES>,;-I>"
            "$<$<BOOL:${definitions}>:-D$<JOIN:${definitions},;-D>>" "$<TARGET_PROPERTY:${target},COMPILE_OPTIONS>" ${ARGN}
            WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} COMMAND_EXPAND_LISTS)
        set_tests_properties(bench/${name} PROPERTIES LABELS example)
    endif()
endfunction()

# A Google Benchmark program, built and run by ./run bench; a test compiles its sources without code, which takes most of the time:
#   gnomon_bench(NAME hamburger4 SOURCES a.cpp [LIBRARIES xsimd])
function(gnomon_bench)
    cmake_parse_arguments(PARSE_ARGV 0 bench "" "NAME" "SOURCES;LIBRARIES")
    add_executable(bench_${bench_NAME} EXCLUDE_FROM_ALL ${bench_SOURCES})
    list(REMOVE_ITEM bench_SOURCES core/main.cpp)
    bench_compiles(${bench_NAME} bench_${bench_NAME} ${bench_SOURCES})
    set_target_properties(bench_${bench_NAME} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bench)
    target_link_libraries(bench_${bench_NAME} PRIVATE benchmark::benchmark gnomon_strict ${bench_LIBRARIES})
    add_dependencies(gnomon_benches bench_${bench_NAME})
endfunction()

# A program on the renderer:
#   gnomon_example(NAME gnomon_demo SOURCES main.cpp [LIBRARIES CLI11::CLI11])
function(gnomon_example)
    cmake_parse_arguments(PARSE_ARGV 0 example "" "NAME" "SOURCES;LIBRARIES")
    add_executable(${example_NAME} ${example_SOURCES})
    set_target_properties(${example_NAME} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/examples)
    target_link_libraries(${example_NAME} PRIVATE gnomon_renderer gnomon_strict ${example_LIBRARIES})
endfunction()
