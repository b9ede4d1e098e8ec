// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>

#include "tests/app/cli/bench/figures.h"

namespace orbwatch::app::cli {
namespace {

void expect_part(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

TEST(BenchVerdict, SaysTheMarginOfTheScarcestPart) {
  const Verdict verdict = judge(some_figures());
  EXPECT_TRUE(verdict.fits);
  EXPECT_NEAR(verdict.used, 0.5, 1e-9);
  EXPECT_EQ(verdict.sentence,
            "fits: 30 frame sets per second take 50 % of the processor time of the pipeline's "
            "thread, margin 50 %");
  BenchFigures few_cores = some_figures();
  few_cores.cores = 1;
  const Verdict tight = judge(few_cores);
  EXPECT_NEAR(tight.used, 1.0, 1e-9);
  expect_part(tight.sentence, "of 1 cores");
}

TEST(BenchVerdict, OneFrameSetAfterTheOtherMustBeInTime) {
  BenchFigures figures = some_figures();
  figures.busy.p99 *= 2.5;
  const Verdict verdict = judge(figures);
  EXPECT_FALSE(verdict.fits);
  EXPECT_NEAR(verdict.used, 1.25, 1e-9);
  EXPECT_EQ(verdict.sentence,
            "does not fit: 30 frame sets per second take 125 % of the processor time of the "
            "pipeline's thread; lower first: the size of view wide, 1024x512");
}

TEST(BenchVerdict, AllCoresMustBeEnough) {
  BenchFigures figures = some_figures();
  for (double& mean : figures.means) mean *= 4.4;
  const Verdict verdict = judge(figures);
  EXPECT_FALSE(verdict.fits);
  EXPECT_NEAR(verdict.used, 1.1, 1e-9);
  expect_part(verdict.sentence, "110 % of the processor time of 4 cores");
}

TEST(BenchVerdict, LateFrameSetsAndPicturesThatAreLeftOutCountWhateverTheTime) {
  BenchFigures figures = some_figures();
  figures.overruns = 3;
  EXPECT_TRUE(judge(figures).fits) << "one of a hundred";
  figures.overruns = 6;
  EXPECT_FALSE(judge(figures).fits);
  expect_part(judge(figures).sentence, "2 % of them were late; find what else runs");
  figures.realtime = false;
  expect_part(judge(figures).sentence, "allow real-time priorities");
  figures = some_figures();
  figures.views[0].published = 150;
  figures.views[0].skipped = 150;
  EXPECT_FALSE(judge(figures).fits);
  expect_part(judge(figures).sentence, "50 % of a view's pictures were left out");
}

TEST(BenchVerdict, AdvisesTheSettingBehindTheCostliestStage) {
  const std::array<std::string, kStages> advice{"pixel_format that is not compressed",
                                                "interpolation = \"bilinear\"",
                                                "view wide, 1024x512",
                                                "the recipe's regions",
                                                "the number of views",
                                                "[dds.jpeg]"};
  for (std::size_t stage = 0; stage < kStages; ++stage) {
    BenchFigures figures = some_figures();
    figures.busy.p99 *= 3;
    figures.means[stage] = 1000;
    expect_part(judge(figures).sentence, "lower first: ");
    expect_part(judge(figures).sentence, advice[stage]);
  }
}

}  // namespace
}  // namespace orbwatch::app::cli
