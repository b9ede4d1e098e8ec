// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/alignment/aligned_site.h"
#include "app/files/resolve.h"

namespace orbwatch::app {

/// The part of a site that alignment and watching go by. Reentrant.
AlignedSite aligned_site(const Resolved& site);

}  // namespace orbwatch::app
