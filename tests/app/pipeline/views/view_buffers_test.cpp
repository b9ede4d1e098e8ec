// SPDX-License-Identifier: Apache-2.0
#include "app/pipeline/views/view_buffers.h"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "tests/app/pipeline/views/thermal_view.h"

namespace orbwatch::app::pipeline {
namespace {

constexpr std::size_t kMeasuredSource = 0;

/// View of 96x64 pixels unless stated.
ViewPlan view(std::size_t index, bool is_measured = false, int width = 96, int height = 64) {
  ViewPlan plan = thermal_view(index, "view_" + std::to_string(index));
  optics::ViewSpec spec = plan.projection.spec();
  spec.width = width;
  spec.height = height;
  plan.projection = optics::ViewProjection::make(spec).value();
  if (is_measured) plan.measured = kMeasuredSource;
  return plan;
}

std::size_t count(const std::vector<ViewPlan>& displays,
                  const std::vector<std::vector<ViewPlan>>& recipes, const KeptViews& kept,
                  int width = 96, int height = 64) {
  const std::vector<ViewBuffers::Views> measured(recipes.begin(), recipes.end());
  return ViewBuffers(displays, measured, kept).count(width, height);
}

TEST(ViewBuffers, AreAsManyAsAreRenderedTogetherAndKept) {
  const ViewPlan seen = view(0), measured = view(1, true);
  EXPECT_EQ(count({seen}, {}, {}), 1U);
  EXPECT_EQ(count({seen, seen, seen}, {}, {}), 1U) << "one after the other";
  EXPECT_EQ(count({}, {{measured, measured, measured}}, {}), 3U) << "together";
  EXPECT_EQ(count({seen}, {{measured, measured}}, {}), 2U);
  EXPECT_EQ(count({seen, seen}, {}, {2, 0}), 5U);
  EXPECT_EQ(count({seen, seen}, {}, {0, 3}), 4U);
  EXPECT_EQ(count({seen}, {{measured, measured}}, {2, 3}), 2U + 2 * 3 + 3);
}

TEST(ViewBuffers, ServeOneRecipeAndWhatIsKeptOfTheOneBefore) {
  const ViewPlan one = view(0, true);
  const std::vector<std::vector<ViewPlan>> recipes{{one}, {one, one, one}, {one}, {one, one}};
  EXPECT_EQ(count({}, recipes, {}), 3U);
  EXPECT_EQ(count({}, recipes, {1, 0}), 3U + 3 + 2);
}

TEST(ViewBuffers, AreOfTheirSizeOnly) {
  const ViewPlan small = view(0), large = view(1, true, 128, 96);
  EXPECT_EQ(count({small, small}, {{large}}, {1, 1}), 1U + 2 + 1);
  EXPECT_EQ(count({small, small}, {{large}}, {1, 1}, 128, 96), 1U + 1 + 1);
  EXPECT_EQ(count({small}, {}, {1, 1}, 64, 96), 0U) << "no view is of that size";
}

TEST(ViewBuffers, AreSharedByViewsOfASizeUnderTheirNames) {
  std::vector<ViewPlan> displays{view(0)}, one{view(1, true)}, other{view(2, true)};
  ViewBuffers buffers(displays, {one, other}, {});
  const std::uint8_t* memory = nullptr;
  for (const ViewPlan& plan : {displays[0], one[0], other[0]}) {
    const auto buffer = buffers.acquire(plan);
    ASSERT_TRUE(buffer);
    const std::uint8_t* const before = std::exchange(memory, buffer->bytes.data());
    EXPECT_TRUE(!before || before == memory);
    EXPECT_EQ(buffer->index, plan.index);
    EXPECT_EQ(buffer->name, plan.name);
    EXPECT_NE(buffer->name.data(), plan.name.data()) << "a plan may be replaced";
    EXPECT_EQ(buffer->picture.planes[0].data, nullptr);
    EXPECT_EQ(buffer->radiometric.empty(), !plan.measured);
    EXPECT_FALSE(buffers.acquire(plan)) << "there is one";
  }
}

TEST(ViewBuffers, HaveOneThatNoSinkGetsForEachMeasuredView) {
  std::vector<ViewPlan> displays{view(0)}, recipe{view(1, true), view(2, true)};
  ViewBuffers buffers(displays, {recipe}, {});
  const auto one = buffers.acquire_unshared(recipe[0]), two = buffers.acquire_unshared(recipe[1]);
  ASSERT_TRUE(one && two);
  EXPECT_FALSE(buffers.acquire_unshared(recipe[0]));
  const auto shared = buffers.acquire(recipe[0]);
  EXPECT_NE(shared->bytes.data(), one->bytes.data());
}

/// A camera that connects late delivers another depth than the assumed one.
TEST(ViewBuffers, FitTheViewWhateverItsCameraDelivers) {
  std::vector<ViewPlan> recipe{view(0, true)};
  ViewBuffers buffers({}, {recipe}, {});
  EXPECT_EQ(buffers.acquire(recipe[0])->radiometric.width, 96);
  EXPECT_TRUE(buffers.acquire(recipe[0])->luminance.empty());
  ViewPlan anew = recipe[0];
  anew.sources[kMeasuredSource].format.format = PixelFormat::Grey;
  const auto buffer = buffers.acquire(anew);
  EXPECT_EQ(buffer->luminance.width, 96);
  EXPECT_TRUE(buffer->radiometric.empty());
}

/// Share of the memory's pages that the kernel has allocated.
double resident_share(const void* memory, std::size_t bytes) {
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  const std::uintptr_t begin = (reinterpret_cast<std::uintptr_t>(memory) + page - 1) / page * page;
  const std::size_t pages = bytes / page - 1;
  std::vector<unsigned char> resident(pages);
  EXPECT_EQ(::mincore(reinterpret_cast<void*>(begin), pages * page, resident.data()), 0);
  const auto count = std::ranges::count_if(resident, [](unsigned char p) { return (p & 1) != 0; });
  return static_cast<double>(count) / static_cast<double>(pages);
}

/// Page faults of this thread so far. Huge pages take one for 2 MiB.
long page_faults() {
  rusage usage{};
  EXPECT_EQ(::getrusage(RUSAGE_THREAD, &usage), 0);
  return usage.ru_minflt;
}

TEST(ViewBuffers, TakeNoMemoryBeforeTheyAreUsed) {
  constexpr int kWidth = 6144, kHeight = 4096;  // above the size that malloc returns from its heap
  const long before = page_faults();
  const View view = make_view(kWidth, kHeight);
  const long faults = page_faults() - before;
  // The kernel may allocate pages of its own accord, but no fault does.
  constexpr long kFaultsOfATenth = 5;
  EXPECT_TRUE(faults < kFaultsOfATenth ||
              (resident_share(view.bytes.data(), view.bytes.size()) < 0.1 &&
               resident_share(view.words.data(), 2 * view.words.size()) < 0.1))
      << faults;
  View used = make_view(kWidth, kHeight);
  const long unused = page_faults();
  std::ranges::fill(used.words, std::uint16_t{1});
  EXPECT_GT(resident_share(used.words.data(), 2 * used.words.size()), 0.9);
  EXPECT_GT(page_faults() - unused, kFaultsOfATenth);
}

}  // namespace
}  // namespace orbwatch::app::pipeline
