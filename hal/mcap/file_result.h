// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <system_error>
#include <tl/expected.hpp>
#include <utility>

namespace orbwatch::hal::mcap {

/// Reason why a file cannot be read or written.
struct FileError {
  int number = 0;       ///< errno; 0: the content is refused
  std::string message;  ///< one sentence: what, its byte offset, what would be right
};

template <class T = void>
using FileResult = tl::expected<T, FileError>;

/// Error of the content.
inline tl::unexpected<FileError> refuse(std::string message) {
  return tl::unexpected<FileError>(FileError{0, std::move(message)});
}

/// Error of the system or of a call; `number` is an errno.
inline tl::unexpected<FileError> failed(int number, const std::string& what) {
  return tl::unexpected<FileError>(
      FileError{number, what + ": " + std::system_category().message(number)});
}

/// Passes an error on as one of another type of result.
template <class T>
tl::unexpected<FileError> error_of(tl::expected<T, FileError>& result) {
  return tl::unexpected<FileError>(std::move(result.error()));
}

}  // namespace orbwatch::hal::mcap
