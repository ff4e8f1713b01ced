# find_package(gnomon) ends here: it defines gnomon::gnomon, gnomon::bit_exact and gnomon::shaders. The function keeps what
# gnomon-targets.cmake sets from the caller's variables.
function(gnomon_import)
    include("${CMAKE_CURRENT_FUNCTION_LIST_DIR}/gnomon-targets.cmake")
    foreach(component IN LISTS gnomon_FIND_COMPONENTS)
        if(gnomon_FIND_REQUIRED_${component})
            set(gnomon_FOUND FALSE PARENT_SCOPE)
            set(gnomon_NOT_FOUND_MESSAGE "gnomon has no components, and so no '${component}'" PARENT_SCOPE)
        endif()
    endforeach()
endfunction()
gnomon_import()
