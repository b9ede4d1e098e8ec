// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/site/view_memory.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "app/pipeline/views/view_buffers.h"

namespace orbwatch::app::daemon {
namespace {

std::string gigabytes(std::uint64_t bytes) {
  constexpr double kGigabyte = 1e9;
  char text[32];
  std::snprintf(text, sizeof text, "%.1f GB", static_cast<double>(bytes) / kGigabyte);
  return text;
}

}  // namespace

std::uint64_t view_memory(const files::Resolved& site) {
  std::uint64_t displayed = 0;
  for (const pipeline::ViewSettings& view : site.site.views)
    displayed += pipeline::display_bytes(view.width, view.height);
  std::uint64_t largest = 0;
  for (const pipeline::Recipe& recipe : site.recipes) {
    std::uint64_t measured = 0;
    for (const pipeline::ViewSettings& view : recipe.views)
      measured += pipeline::measured_bytes(view.width, view.height);
    largest = std::max(largest, measured);
  }
  return displayed + largest;
}

std::uint64_t computer_memory() {
  const long pages = ::sysconf(_SC_PHYS_PAGES), size = ::sysconf(_SC_PAGESIZE);
  if (pages <= 0 || size <= 0) return 0;
  return static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(size);
}

Result<> check_view_memory(const files::Resolved& site, std::uint64_t memory) {
  const std::uint64_t needed = view_memory(site);
  if (memory == 0 || needed <= memory) return {};
  return fail("the views need " + gigabytes(needed) + " of memory at least, this computer has " +
              gigabytes(memory) + "; make width and height of views smaller, or state fewer");
}

}  // namespace orbwatch::app::daemon
