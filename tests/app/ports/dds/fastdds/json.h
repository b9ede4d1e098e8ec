// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "tests/app/ports/dds/fastdds/messages.h"

namespace orbwatch::tests::ros {

/// A message as members of a JSON object, without its braces. Long data shows as its length and its
/// CRC-32 (that of zlib and PNG).
std::string json(const Image& image);
std::string json(const CompressedImage& image);
std::string json(const CameraInfo& info);
std::string json(const DiagnosticArray& array);
std::string json(const ProcessState& state);
std::string json(const Event& event);
std::string json(const DiscoveryInfo& info);
std::string json(const HumbleDiscoveryInfo& info);

/// `text` in quotes.
std::string quoted(const std::string& text);

}  // namespace orbwatch::tests::ros
