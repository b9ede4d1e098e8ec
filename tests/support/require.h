#pragma once

#include <cerrno>
#include <system_error>

namespace orbwatch::tests {

/// Throws what errno says when it is not done.
inline void require(bool done) {
  if (!done) throw std::system_error(errno, std::generic_category());
}

}  // namespace orbwatch::tests
