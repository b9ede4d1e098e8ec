// SPDX-License-Identifier: Apache-2.0
#include "hal/libraries.h"

#include <gpiod.h>

namespace orbwatch::hal {

std::vector<std::pair<std::string, std::string>> library_versions() {
#ifdef ORBWATCH_GPIOD_2
  const char* const gpiod = gpiod_api_version();
#else
  const char* const gpiod = gpiod_version_string();
#endif
  return {{"libgpiod", gpiod}, {"libjpeg-turbo", ORBWATCH_LIBJPEG_TURBO_VERSION}};
}

}  // namespace orbwatch::hal
