// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace orbwatch::app::web {

/// A certificate, with those of its issuers, and its key.
struct PemPair {
  std::string certificate;
  std::string key;
};

}  // namespace orbwatch::app::web
