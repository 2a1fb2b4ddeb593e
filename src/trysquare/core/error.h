// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

namespace trysquare {

/// Base of everything this library throws. Python sees `trysquare.Error`.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A setting or argument outside its documented range. The message names the parameter, its value and the range.
/// The command line exits with 2.
class InvalidArgument : public Error {
 public:
  using Error::Error;
};

/// A file that is missing, malformed or truncated, or that cannot be written. The message reads
/// `<path>: <line N | byte N>: <what was found, what was expected>`. The command line exits with 3.
class IoError : public Error {
 public:
  using Error::Error;
};

}  // namespace trysquare
