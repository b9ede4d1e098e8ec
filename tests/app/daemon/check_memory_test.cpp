// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <functional>
#include <new>

#include "app/daemon/site/build.h"
#include "app/daemon/site/site_check.h"
#include "tests/app/daemon/demo_site.h"

namespace {

std::atomic<std::size_t> used = 0, most_used = 0;  // bytes of all threads

}  // namespace

void* operator new(std::size_t size) {
  void* const memory = std::malloc(size);
  if (memory == nullptr) throw std::bad_alloc();
  const std::size_t now = used += malloc_usable_size(memory);
  for (std::size_t most = most_used; most < now && !most_used.compare_exchange_weak(most, now);) {
  }
  return memory;
}
void operator delete(void* memory) noexcept {
  used -= malloc_usable_size(memory);
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept { operator delete(memory); }

namespace orbwatch::app::daemon {
namespace {

constexpr int kWidth = 1920, kHeight = 1080;

/// Demonstration with a measured view of that size.
files::Resolved site() {
  auto site = demo();
  pipeline::ViewSettings& view = site.recipes.front().views[0];
  view.width = kWidth;
  view.height = kHeight;
  return site;
}

std::size_t most_used_by(const std::function<void()>& work) {
  const std::size_t before = used;
  most_used = before;
  work();
  return most_used - before;
}

TEST(CheckSite, NeedsNoMemoryOfARun) {
  const files::Resolved checked = site();
  constexpr std::size_t kPixels = std::size_t{kWidth} * kHeight;
  const std::size_t check = most_used_by([&] { EXPECT_TRUE(check_site(checked, Dates::Checked)); });
  EXPECT_LT(check, kPixels) << "nothing of a view's size";
  const std::size_t built = most_used_by([&] {
    const auto plan = SitePlan::make(checked, expected_formats(checked));
    ASSERT_TRUE(plan);
    EXPECT_TRUE(build(checked, *plan));
  });
  EXPECT_GT(built, 10 * check) << "what a run needs is counted";
}

}  // namespace
}  // namespace orbwatch::app::daemon
