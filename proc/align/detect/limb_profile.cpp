#include "proc/align/detect/limb_profile.h"

namespace orbwatch::align::limb_profile {

const std::array<float, kColumns>& at(std::size_t kind) {
  static constexpr std::array<std::array<float, kColumns>, kKinds> kTable{{
#include "proc/align/detect/limb_profile.inc"
  }};
  return kTable[kind];
}

}  // namespace orbwatch::align::limb_profile
