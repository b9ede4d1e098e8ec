// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cerrno>
#include <system_error>

namespace orbwatch::tests {

/// Throws errno's error unless `done`.
inline void require(bool done) {
  if (!done) throw std::system_error(errno, std::generic_category());
}

}  // namespace orbwatch::tests
