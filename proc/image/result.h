// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace orbwatch {

/// An error in one line for an operator: its kind, its place, and the remedy.
struct Error {
  std::string message;
};

/// A value or the reason why there is none.
template <class T = void>
using Result = tl::expected<T, Error>;

/// Shorthand for `return fail("...")` in a function that returns a Result.
inline tl::unexpected<Error> fail(std::string message) {
  return tl::unexpected<Error>(Error{std::move(message)});
}

}  // namespace orbwatch
