// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "app/alignment/aligned_site.h"

namespace orbwatch::app {

/// CRC-32 of a camera's alignment in force: its name, the members of the rig that place its picture
/// of the ball, and the accepted alignment that counts. Alignments that were accepted one after the
/// other differ, although they may state the same. Reentrant.
std::uint32_t alignment_checksum(const AlignedSite& site, std::size_t camera);

}  // namespace orbwatch::app
