#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace orbwatch {

/// What went wrong, in one line for an operator: what, where, and what would be right.
struct Error {
  std::string message;
};

/// A value or the reason why there is none.
template <class T = void>
using Result = tl::expected<T, Error>;

/// `return fail("...")` from a function that returns a Result.
inline tl::unexpected<Error> fail(std::string message) {
  return tl::unexpected<Error>(Error{std::move(message)});
}

}  // namespace orbwatch
