// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/aligned_site.h"

namespace orbwatch::app {

AlignedSite aligned_site(const Resolved& site) {
  AlignedSite aligned{{}, site.rig, site.alignments, site.site.place};
  for (std::size_t i = 0; i < site.site.cameras.size(); ++i) {
    const CameraSettings& camera = site.site.cameras[i];
    aligned.cameras.push_back({camera.name, site.rig_cameras[i], camera.watch});
  }
  return aligned;
}

}  // namespace orbwatch::app
