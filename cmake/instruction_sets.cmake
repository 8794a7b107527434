# Selects the instruction sets (processors) for which the program is built.
set(default_arch "")
if(CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64")
  set(default_arch x86-64-v3)
endif()
set(BAREHAND_ARCH "${default_arch}" CACHE STRING "Value of -march; empty leaves it to the compiler")
set(BAREHAND_MORE_ARCHS "" CACHE STRING
    "Further values of -march (x86-64-v3, x86-64-v4) that the package carries the program for; the loader takes the best")
set(BAREHAND_LIBRARIES lib/${CMAKE_LIBRARY_ARCHITECTURE}/barehand)  # folder of libraries that only the program links

# Compiles a target for the instruction set BAREHAND_ARCH, which must be the same in every translation unit, since
# Eigen's alignment depends on it. On a processor without it, the loader ends the program with a message, instead of an
# illegal instruction later on.
function(barehand_instruction_set target)
  if(BAREHAND_ARCH)
    target_compile_options(${target} INTERFACE -march=${BAREHAND_ARCH})
  endif()
  if(BAREHAND_ARCH MATCHES "^x86-64-v[234]$")
    target_link_options(${target} INTERFACE -Wl,-z,${BAREHAND_ARCH})
  endif()
endfunction()

# Builds the program's library again for each of BAREHAND_MORE_ARCHS, and installs it where glibc's loader looks for it.
function(barehand_more_instruction_sets)
  include(ExternalProject)
  foreach(arch IN LISTS BAREHAND_MORE_ARCHS)
    set(build ${PROJECT_BINARY_DIR}/${arch})
    ExternalProject_Add(barehand_${arch}
      SOURCE_DIR ${PROJECT_SOURCE_DIR}
      BINARY_DIR ${build}
      CMAKE_CACHE_ARGS -DBAREHAND_ARCH:STRING=${arch} -DBAREHAND_TESTS:BOOL=OFF
                       -DCMAKE_BUILD_TYPE:STRING=${CMAKE_BUILD_TYPE} -DCMAKE_CXX_COMPILER:STRING=${CMAKE_CXX_COMPILER}
                       -DCMAKE_SHARED_LINKER_FLAGS:STRING=${CMAKE_SHARED_LINKER_FLAGS}
      BUILD_COMMAND ${CMAKE_COMMAND} --build ${build} --target barehand_program
      INSTALL_COMMAND ""
      BUILD_ALWAYS ON
      USES_TERMINAL_BUILD ON)
    install(FILES ${build}/src/app/libbarehand.so DESTINATION ${BAREHAND_LIBRARIES}/glibc-hwcaps/${arch})
  endforeach()
endfunction()
