# The routes of ./run test --all: a second Vulkan driver (SwiftShader, of Chromium), WebGPU (Dawn, from npm, on
# SwiftShader), and OpenGL ES. What they need beyond the program is built by gnomon_heavy alone.
add_custom_target(gnomon_heavy)

function(heavy_test name)
    parity_test(${name} ${ARGN})
    set_tests_properties(parity/${name} PROPERTIES LABELS "shader;heavy")
endfunction()

# The examples of a section of docs/shaders.md, by a checker.
set(examples python3 -B ${CMAKE_CURRENT_SOURCE_DIR}/../hygiene/examples.py ${PROJECT_SOURCE_DIR} ${GNOMON_SHADERS})

heavy_test(swiftshader glsl-swiftshader hlsl-swiftshader ROWS 262144)

find_path(GNOMON_EGL_INCLUDE EGL/egl.h)
find_path(GNOMON_GLES_INCLUDE GLES3/gl32.h)
find_library(GNOMON_EGL EGL)
find_library(GNOMON_GLES GLESv2)
if(GNOMON_EGL_INCLUDE AND GNOMON_GLES_INCLUDE AND GNOMON_EGL AND GNOMON_GLES)
    target_sources(parity PRIVATE gles_route.cpp fragment_route.cpp)
    target_compile_definitions(parity PRIVATE GNOMON_PARITY_GLES)
    target_link_libraries(parity PRIVATE ${GNOMON_EGL} ${GNOMON_GLES})
    parity_shaders(essl modules gnomon_heavy)

    add_executable(integer_map EXCLUDE_FROM_ALL integer_map.cpp)
    target_link_libraries(integer_map PRIVATE gnomon_strict ${GNOMON_EGL} ${GNOMON_GLES})
    add_dependencies(gnomon_heavy integer_map)
    add_test(NAME gles/integer_map COMMAND ${examples} "OpenGL ES and WebGL without 16-bit UNORM" $<TARGET_FILE:integer_map>)
    set_tests_properties(gles/integer_map PROPERTIES LABELS "shader;heavy" SKIP_RETURN_CODE 77)
endif()
heavy_test(gles essl-gles)
parity_shaders(essl300 modules gnomon_heavy)
parity_shaders(essl300_kept modules gnomon_heavy)
heavy_test(gles300 essl300-gles ROWS 65536)
heavy_test(webgl essl300-webgl ROWS 65536)
# As an engine has it: the kernels of parity/plain, and the contract of all.
heavy_test(essl300_plain essl300-gles-plain essl300-webgl-plain KERNELS ${plain_kernels})
heavy_test(essl300_contract essl300-gles-plain essl300-webgl-plain CONTRACT ROWS 16384)

# Dawn, Tint, naga and naga_oil as node's modules, in the versions of package-lock.json, over the network.
parity_shaders(wgsl kernels.wgsl gnomon_heavy)
parity_shaders(wgsl_plain kernels.wgsl gnomon_heavy)
if(GNOMON_GLSLANG AND GNOMON_SPIRV_AS)
    parity_shaders(naga modules gnomon_heavy)
endif()
find_program(GNOMON_NODE node)
find_program(GNOMON_NPM npm)
if(GNOMON_NODE AND GNOMON_NPM)
    set(dawn ${CMAKE_CURRENT_BINARY_DIR}/dawn)
    file(GLOB scripts RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} CONFIGURE_DEPENDS dawn/*)
    foreach(script IN LISTS scripts)
        configure_file(${script} ${script} COPYONLY)
    endforeach()
    # naga-wasm asks for a later node than it needs, hence the log level; nothing here needs its scripts of installation.
    add_custom_command(OUTPUT ${dawn}/node_modules/.package-lock.json
        COMMAND ${GNOMON_NPM} ci --ignore-scripts --no-audit --no-fund --loglevel=error
        DEPENDS dawn/package-lock.json WORKING_DIRECTORY ${dawn} COMMENT "Fetching Dawn, naga and naga_oil from npm")
    add_custom_target(gnomon_dawn DEPENDS ${dawn}/node_modules/.package-lock.json)
    add_dependencies(gnomon_heavy gnomon_dawn)
    add_test(NAME wgsl/packages COMMAND ${GNOMON_NODE} ${dawn}/check.mjs ${GNOMON_SHADERS})
    add_test(NAME wgsl/example COMMAND ${examples} WebGPU ${GNOMON_NODE} ${dawn}/check.mjs)
    add_test(NAME wgsl/bevy COMMAND ${examples} Bevy ${GNOMON_NODE} ${dawn}/bevy.mjs)
    set_tests_properties(wgsl/packages wgsl/example wgsl/bevy PROPERTIES LABELS "shader;heavy" SKIP_RETURN_CODE 77)
endif()
heavy_test(wgsl wgsl-dawn naga-dawn ROWS 65536)
heavy_test(wgsl_plain wgsl-plain wgsl-plain-gles KERNELS ${plain_kernels})

# What translators make of the modules of parity/plain, as engines hand it to other compilers: translated_shaders(NAME ROUTE
# COMMAND...) with a route of translated.py, and the command that runs naga. The kernels of parity/plain have the same bits, all
# others keep the contract. Metal's text is compiled under fast mathematics, which loses NaN.
find_program(GNOMON_SPIRV_CROSS spirv-cross)
if(GNOMON_GLSLANG AND GNOMON_SPIRV_AS)
    parity_shaders(glsl_fragment modules gnomon_heavy)
endif()
function(translated_shaders name route)
    set(folder ${CMAKE_CURRENT_BINARY_DIR}/translated/${name})
    set(language glsl)
    if(route MATCHES "essl300|glsl330") # no compute shaders
        set(language glsl_fragment)
    endif()
    set(modules ${CMAKE_CURRENT_BINARY_DIR}/${language})
    add_custom_command(OUTPUT ${folder}/modules
        COMMAND python3 ${CMAKE_CURRENT_SOURCE_DIR}/translated.py ${route} ${modules} ${folder} ${ARGN}
        DEPENDS translated.py dawn/translate.mjs ${modules}/modules)
    add_custom_target(parity_translated_${name} DEPENDS ${folder}/modules)
    add_dependencies(parity_translated_${name} parity_${language}_shaders)
    add_dependencies(gnomon_heavy parity_translated_${name})
    if(route STREQUAL "msl" AND GNOMON_CLANG)
        if(ARGN)
            set(main main_)
        else()
            set(main main0)
        endif()
        # -ffast-math at the link would make the whole process flush denormals.
        add_custom_command(OUTPUT ${folder}.so
            COMMAND ${GNOMON_CLANG} -x c++ -std=c++17 -O2 -ffast-math -U__FAST_MATH__ -DMAIN=${main} -w -fPIC
                -Xclang -cl-single-precision-constant -fno-strict-aliasing -fvisibility=hidden
                -I${CMAKE_CURRENT_SOURCE_DIR}/../hygiene/metal -I${folder} -c
                ${CMAKE_CURRENT_SOURCE_DIR}/translated_metal.cpp -o ${folder}.o
            COMMAND ${GNOMON_CLANG} -shared ${folder}.o -o ${folder}.so
            DEPENDS translated_metal.cpp module.hpp ../hygiene/metal/metal_stdlib ${folder}/modules)
        add_custom_target(parity_${name} DEPENDS ${folder}.so)
        add_dependencies(parity_${name} parity_translated_${name})
        add_dependencies(gnomon_heavy parity_${name})
    endif()
endfunction()
set(translators "")
if(GNOMON_GLSLANG AND GNOMON_SPIRV_AS AND GNOMON_SPIRV_CROSS)
    list(APPEND translators cross)
endif()
if(GNOMON_GLSLANG AND GNOMON_SPIRV_AS AND TARGET gnomon_dawn)
    list(APPEND translators naga)
endif()
foreach(translator IN LISTS translators)
    set(command "")
    if(translator STREQUAL "naga")
        set(command ${GNOMON_NODE} ${dawn}/translate.mjs)
    endif()
    set(routes essl300 glsl330 hlsl msl)
    if(translator STREQUAL "cross") # naga writes no bindings, which two buffers need
        list(APPEND routes essl310)
    endif()
    foreach(route IN LISTS routes)
        translated_shaders(${translator}_${route} ${route} ${command})
        if(command)
            add_dependencies(parity_translated_${translator}_${route} gnomon_dawn)
        endif()
    endforeach()
endforeach()
# What holds under fast mathematics, and the intensities of filters.
set(held_kernels nearest_integer two_product two_difference two_difference_ordered subtract_product subtract_product_ordered
    subtract_product_rounded saturate_or_zero)
foreach(file ${tables})
    file(STRINGS ${file} some REGEX "^[a-z0-9_]+_(intensity(_within)?|lower|bounds|side|end):.* -> unit")
    list(APPEND intensities ${some})
endforeach()
list(TRANSFORM intensities REPLACE ":.*" "")
list(FILTER intensities EXCLUDE REGEX "^range_")
set(routes cross-essl300 cross-essl310 cross-glsl330 cross-hlsl naga-essl300 naga-glsl330 naga-hlsl)
heavy_test(translated ${routes} KERNELS ${plain_kernels} ROWS 65536)
heavy_test(translated_contract ${routes} CONTRACT ROWS 16384)
heavy_test(translated_metal cross-msl naga-msl KERNELS ${held_kernels} ROWS 65536)
heavy_test(translated_metal_range cross-msl naga-msl RANGE KERNELS ${intensities} ROWS 16384)

# The headers as they are, under liberties that no macro tells of: Metal's text by clang under fast mathematics, and OpenCL's
# flags, which PoCL takes from its environment. Exact products, rounding and clamps have their bits, and intensities of filters
# keep the contract. The kernels of motion that compare a NaN may lose it, in Metal.
set(clamps clamp_or_nan clamp_or_high)
if(GNOMON_CLANG)
    set(metal_fast ${CMAKE_CURRENT_BINARY_DIR}/metal_fast)
    # -ffast-math at the link would make the whole process flush denormals.
    add_custom_command(OUTPUT ${metal_fast}.so
        COMMAND ${GNOMON_CLANG} -x c++ -std=c++14 -D__METAL_VERSION__=300 -O2 $<$<BOOL:${GNOMON_NATIVE}>:-march=native>
            -ffast-math -U__FAST_MATH__ -w -fPIC -fvisibility=hidden
            -I${CMAKE_CURRENT_SOURCE_DIR}/../hygiene/metal -I${include} -I${CMAKE_CURRENT_BINARY_DIR}
            -I${PROJECT_BINARY_DIR}/tests/support/include -c ${CMAKE_CURRENT_SOURCE_DIR}/metal.cpp -o ${metal_fast}.o
        COMMAND ${GNOMON_CLANG} -shared ${metal_fast}.o -o ${metal_fast}.so
        DEPENDS metal.cpp module.hpp ../hygiene/metal/metal_stdlib metal/kernels.metal parity_metal_shaders gnomon_kernel_table)
    add_custom_target(parity_metal_fast DEPENDS ${metal_fast}.so)
    add_dependencies(gnomon_heavy parity_metal_fast)
endif()
heavy_test(metal_fast metal-fast KERNELS ${held_kernels} ${clamps} ROWS 65536)
heavy_test(metal_fast_contract metal-fast CONTRACT KERNELS ${intensities} ROWS 16384)
heavy_test(metal_fast_range metal-fast RANGE ROWS 16384)
heavy_test(opencl_fast opencl-pocl KERNELS ${held_kernels} ${clamps} ROWS 65536)
heavy_test(opencl_fast_contract opencl-pocl CONTRACT KERNELS ${intensities} ROWS 16384)
set_tests_properties(parity/opencl_fast parity/opencl_fast_contract PROPERTIES ENVIRONMENT
    "POCL_EXTRA_BUILD_FLAGS=-cl-unsafe-math-optimizations -cl-mad-enable -cl-no-signed-zeros -cl-denorms-are-zero")
# The control: PoCL does read its environment.
heavy_test(opencl_fast_control opencl-pocl KERNELS nearest_integer ROWS 64)
set_tests_properties(parity/opencl_fast_control PROPERTIES ENVIRONMENT POCL_EXTRA_BUILD_FLAGS=-cl-finite-math-only
    PASS_REGULAR_EXPRESSION "gnomon: -cl-fast-relaxed-math and -cl-finite-math-only void")
