include_guard()

# Warnings are a property of our sources, never of our users: PRIVATE. Errors only where a preset asks
# (CMAKE_COMPILE_WARNING_AS_ERROR), so an old release still builds with a new compiler. Off: missing-field-initializers,
# which g++ 12 raises for designated initializers that leave a member at its default.
function(trysquare_strict_warnings target)
  target_compile_options(
    ${target}
    PRIVATE $<$<NOT:$<CXX_COMPILER_ID:MSVC>>:-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion
            -Wold-style-cast -Wnon-virtual-dtor -Wno-missing-field-initializers> $<$<CXX_COMPILER_ID:MSVC>:/W4 /permissive->)
endfunction()

# trysquare_library(io PUBLIC ... PRIVATE ... PRECOMPILE <header>...): target trysquare_io, for users trysquare::io. The first library is
# trysquare::trysquare. No fused multiply-adds unless written: the same input gives the same bits on every compiler.
function(trysquare_library name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "PUBLIC;PRIVATE;PRECOMPILE")
  set(target trysquare_${name})
  if(name STREQUAL PROJECT_NAME)
    set(target ${name})
  endif()
  add_library(${target})
  add_library(trysquare::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} VERSION ${PROJECT_VERSION}
                                             SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
                                             POSITION_INDEPENDENT_CODE ON) # for the Python module
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_compile_options(${target} PRIVATE $<$<NOT:$<CXX_COMPILER_ID:MSVC>>:-ffp-contract=off>)
  target_link_libraries(${target} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
  target_precompile_headers(${target} PRIVATE ${arg_PRECOMPILE}) # parsing them is half of the work of every file
  trysquare_strict_warnings(${target})
endfunction()

# trysquare_module(LIBRARY io HEADERS a.h SOURCES a.cpp TESTS a_test.cpp)
# One call per folder. HEADERS are public and get installed; files under internal/ are listed in SOURCES.
function(trysquare_module)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "LIBRARY" "HEADERS;SOURCES;TESTS")
  cmake_path(GET CMAKE_CURRENT_SOURCE_DIR FILENAME module)
  get_target_property(target trysquare::${arg_LIBRARY} ALIASED_TARGET)
  target_sources(
    ${target}
    PRIVATE ${arg_SOURCES}
    PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR}/src FILES ${arg_HEADERS})
  if(TRYSQUARE_BUILD_TESTS AND arg_TESTS)
    trysquare_tests(${module} ${arg_TESTS})
    target_link_libraries(trysquare_${module}_tests PRIVATE trysquare::${arg_LIBRARY} trysquare::simulation)
  endif()
endfunction()

# Tests are compiled more often than they run for long: less optimised, a third of the wait is gone.
function(trysquare_test_options target)
  trysquare_strict_warnings(${target})
  target_compile_options(${target} PRIVATE $<$<AND:$<CONFIG:RelWithDebInfo>,$<NOT:$<CXX_COMPILER_ID:MSVC>>>:-O1>)
endfunction()

# trysquare_tests(io a_test.cpp ...): executable trysquare_io_tests, its cases known to ctest as io/Suite.Case.
function(trysquare_tests module)
  if(NOT TARGET trysquare_test_headers)
    file(WRITE ${PROJECT_BINARY_DIR}/test_headers.cpp "")
    add_library(trysquare_test_headers OBJECT ${PROJECT_BINARY_DIR}/test_headers.cpp)
    target_link_libraries(trysquare_test_headers PRIVATE GTest::gmock GTest::gtest_main Eigen3::Eigen)
    target_compile_features(trysquare_test_headers PRIVATE cxx_std_20)
    target_precompile_headers(trysquare_test_headers PRIVATE <Eigen/Core> <gmock/gmock.h> <gtest/gtest.h>)
    trysquare_test_options(trysquare_test_headers)
  endif()
  add_executable(trysquare_${module}_tests ${ARGN})
  target_link_libraries(trysquare_${module}_tests PRIVATE GTest::gmock GTest::gtest_main rapidcheck)
  target_compile_features(trysquare_${module}_tests PRIVATE cxx_std_20)
  target_precompile_headers(trysquare_${module}_tests REUSE_FROM trysquare_test_headers)
  trysquare_test_options(trysquare_${module}_tests)
  gtest_discover_tests(trysquare_${module}_tests TEST_PREFIX "${module}/" DISCOVERY_TIMEOUT 60
                       PROPERTIES LABELS unit ENVIRONMENT RC_PARAMS=seed=2021)
endfunction()
