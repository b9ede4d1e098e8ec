// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "app/model/status/utc_text.h"
#include "app/ports/recorder/messages.h"

/// Stamps of recordings, nanoseconds of UTC since 1970. All reentrant.
namespace orbwatch::app::recorder {

inline Utc utc_at(std::uint64_t nanoseconds) {
  return Utc(std::chrono::duration_cast<Utc::duration>(std::chrono::nanoseconds(nanoseconds)));
}

/// ISO 8601; empty for 0.
inline std::string utc_text_at(std::uint64_t nanoseconds) {
  return utc_text(utc_at(nanoseconds)).value_or("");
}

}  // namespace orbwatch::app::recorder
