# What tests, benches and examples share: warnings, arithmetic, ccache, and a function for each kind of program.
option(GNOMON_NATIVE "Compile tests, benches and examples for this machine's instruction set" ON)

find_program(GNOMON_CCACHE ccache)
if(GNOMON_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    set(CMAKE_CXX_COMPILER_LAUNCHER ${GNOMON_CCACHE})
endif()

add_library(gnomon_strict INTERFACE)
target_link_libraries(gnomon_strict INTERFACE gnomon::bit_exact)
target_compile_options(gnomon_strict INTERFACE
    -Wall -Wextra -Wconversion -Wshadow -Wdouble-promotion -Werror $<$<BOOL:${GNOMON_NATIVE}>:-march=native>)

# A doctest program and its ctest entry:
#   gnomon_test(NAME hamburger4 LABELS unit property SOURCES a.cpp b.cpp [LIBRARIES rapidcheck Eigen3::Eigen])
function(gnomon_test)
    cmake_parse_arguments(PARSE_ARGV 0 test "" "NAME" "LABELS;SOURCES;LIBRARIES")
    add_executable(test_${test_NAME} ${test_SOURCES})
    target_link_libraries(test_${test_NAME} PRIVATE gnomon_doctest gnomon_strict ${test_LIBRARIES})
    add_test(NAME ${test_NAME} COMMAND test_${test_NAME})
    set_tests_properties(${test_NAME} PROPERTIES LABELS "${test_LABELS}")
endfunction()

# A Google Benchmark program:
#   gnomon_bench(NAME hamburger4 SOURCES a.cpp [LIBRARIES xsimd])
function(gnomon_bench)
    cmake_parse_arguments(PARSE_ARGV 0 bench "" "NAME" "SOURCES;LIBRARIES")
    add_executable(bench_${bench_NAME} ${bench_SOURCES})
    target_link_libraries(bench_${bench_NAME} PRIVATE benchmark::benchmark gnomon_strict ${bench_LIBRARIES})
endfunction()

# A program on the rendering toolbox:
#   gnomon_example(NAME gnomon_demo SOURCES main.cpp [LIBRARIES CLI11::CLI11])
function(gnomon_example)
    cmake_parse_arguments(PARSE_ARGV 0 example "" "NAME" "SOURCES;LIBRARIES")
    add_executable(${example_NAME} ${example_SOURCES})
    target_link_libraries(${example_NAME} PRIVATE gnomon_toolbox gnomon_strict ${example_LIBRARIES})
endfunction()
