# Precompiles the headers that most files include: once for the program and once, with GoogleTest, for its tests. This
# saves 25 to 40 % of the time to compile a file. Headers of this project are left out, since a change of one would
# cause everything to be compiled again. -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON shows which files lack an #include.
set(common_headers
  <algorithm> <array> <chrono> <cmath> <cstdint> <filesystem> <fstream> <functional> <map> <memory> <mutex> <optional>
  <span> <string> <thread> <vector> <Eigen/Geometry> <spdlog/fmt/fmt.h> <spdlog/logger.h> <tl/expected.hpp>)

set(common_libraries Eigen3::Eigen spdlog::spdlog tl::expected)  # libraries whose macros must be the same in every file

file(CONFIGURE OUTPUT precompiled.cpp CONTENT "")
add_library(barehand_headers OBJECT ${PROJECT_BINARY_DIR}/precompiled.cpp)
target_link_libraries(barehand_headers PUBLIC barehand_settings ${common_libraries})
target_precompile_headers(barehand_headers PRIVATE ${common_headers})

# Commands do little work of their own, so that they are optimised less. Headers of the option parser are left out: what they
# instantiate would be compiled in every file anew, which takes four seconds.
add_library(barehand_command_headers OBJECT ${PROJECT_BINARY_DIR}/precompiled.cpp)
target_link_libraries(barehand_command_headers PUBLIC barehand_settings ${common_libraries})
set(command_options $<$<CONFIG:Release>:-O1>)
target_compile_options(barehand_command_headers PRIVATE ${command_options})
target_precompile_headers(barehand_command_headers PRIVATE ${common_headers})

# The headers for tests are precompiled with a program, since code of programs is compiled differently from that of
# libraries (-fPIE).
if(BAREHAND_TESTS)
  file(CONFIGURE OUTPUT precompiled_test.cpp CONTENT "int main() {}\n")
  add_executable(barehand_test_headers EXCLUDE_FROM_ALL ${PROJECT_BINARY_DIR}/precompiled_test.cpp)
  target_link_libraries(barehand_test_headers PRIVATE barehand_headers GTest::gmock)
  target_precompile_headers(barehand_test_headers PRIVATE ${common_headers} <gmock/gmock.h> <gtest/gtest.h>)
endif()
