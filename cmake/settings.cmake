# Settings of all targets: language, warnings and sanitizers; and the functions that add libraries and tests.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()
find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  # Without these settings, ccache does not cache files that are compiled with precompiled headers.
  set(CMAKE_CXX_COMPILER_LAUNCHER env CCACHE_SLOPPINESS=pch_defines,time_macros ${CCACHE_PROGRAM})
endif()

add_library(barehand_settings INTERFACE)
target_include_directories(barehand_settings INTERFACE ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR})
# -ffast-math must not be used: with it, small SVDs returned NaN. -fno-math-errno and -fno-trapping-math are enough to
# let the compiler vectorise.
target_compile_options(barehand_settings INTERFACE -Wall -Wextra -Wpedantic -fno-math-errno -fno-trapping-math -pthread)
if(BAREHAND_WERROR)
  # These four stay warnings, because GCC 12 reports them wrongly in libstdc++'s strings, in tl::expected and in Eigen's
  # vectors of three.
  target_compile_options(barehand_settings INTERFACE
    -Werror -Wno-error=restrict -Wno-error=stringop-overflow -Wno-error=array-bounds -Wno-error=maybe-uninitialized)
endif()
barehand_instruction_set(barehand_settings)
set(BAREHAND_TEST_TIMEOUT 300)  # time limit of a test [s]
if(BAREHAND_SANITIZE)
  set(BAREHAND_TEST_TIMEOUT 1800)  # programs with sanitizers are ten to thirty times as slow
  # Let a finding end the program; if it were only printed, the test would still pass.
  target_compile_options(barehand_settings INTERFACE
    -fsanitize=${BAREHAND_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(barehand_settings INTERFACE -fsanitize=${BAREHAND_SANITIZE})
endif()

# barehand_library(core SOURCES a.cpp ... DEPS lib ...) adds the static library barehand_core with the alias
# barehand::core.
function(barehand_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPS;PRIVATE_DEPS" ${ARGN})
  add_library(barehand_${name} STATIC ${ARG_SOURCES})
  add_library(barehand::${name} ALIAS barehand_${name})
  target_link_libraries(barehand_${name} PUBLIC barehand_settings ${ARG_DEPS} PRIVATE ${ARG_PRIVATE_DEPS} ${common_libraries})
  file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  if(folder MATCHES "^src/app")
    target_compile_options(barehand_${name} PRIVATE ${command_options})
    target_precompile_headers(barehand_${name} REUSE_FROM barehand_command_headers)
  else()
    target_precompile_headers(barehand_${name} REUSE_FROM barehand_headers)
  endif()

  # The headers take most of the time of a file, so compile several files at once. Names in the unnamed namespaces of a
  # library's files must therefore differ.
  set_target_properties(barehand_${name} PROPERTIES UNITY_BUILD ${BAREHAND_UNITY} UNITY_BUILD_BATCH_SIZE 8)
  if(BAREHAND_UNITY)  # the compiler takes the files for headers, in which unnamed namespaces would be a mistake
    target_compile_options(barehand_${name} PRIVATE -Wno-subobject-linkage)
  endif()
endfunction()

# barehand_test(core SOURCES a_test.cpp ... DEPS lib ...) adds one test program, whose test cases ctest runs one by one.
# FOREIGN_LEAKS: the test loads plug-ins that leak memory and are unloaded again, so that no suppression can name them;
# leaks are then not checked.
function(barehand_test area)
  cmake_parse_arguments(ARG "FOREIGN_LEAKS" "" "SOURCES;DEPS" ${ARGN})
  set(properties TIMEOUT ${BAREHAND_TEST_TIMEOUT})
  if(ARG_FOREIGN_LEAKS)
    list(APPEND properties ENVIRONMENT ASAN_OPTIONS=detect_leaks=0)
  endif()
  add_executable(${area}_test ${ARG_SOURCES})
  target_include_directories(${area}_test PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_link_libraries(${area}_test PRIVATE ${ARG_DEPS} ${common_libraries} GTest::gtest_main GTest::gmock)
  target_precompile_headers(${area}_test REUSE_FROM barehand_test_headers)
  gtest_discover_tests(${area}_test TEST_PREFIX "${area}." DISCOVERY_TIMEOUT 60 PROPERTIES ${properties})
endfunction()
