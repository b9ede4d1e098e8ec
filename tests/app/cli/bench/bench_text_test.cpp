// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/app/cli/bench/figures.h"

namespace orbwatch::app::cli {
namespace {

TEST(BenchText, IsOneLineOfJson) {
  const BenchFigures figures = some_figures();
  const std::string text = bench_json(figures, judge(figures));
  EXPECT_EQ(text.find('\n'), text.size() - 1);
  const auto json = nlohmann::json::parse(text);
  EXPECT_EQ(json["fits"], true);
  EXPECT_NEAR(json["used"].get<double>(), 0.5, 1e-9);
  EXPECT_EQ(json["verdict"], judge(figures).sentence);
  EXPECT_EQ(json["frame_sets"], 300);
  EXPECT_EQ(json["cores"], 4);
  ASSERT_EQ(json["stages"].size(), kStages);
  EXPECT_EQ(json["stages"][2]["name"], "views");
  EXPECT_DOUBLE_EQ(json["stages"][2]["p99_ms"].get<double>(), figures.stages[2].p99);
  EXPECT_DOUBLE_EQ(json["stages"][2]["mean_ms"].get<double>(), figures.means[2]);
  EXPECT_EQ(json["views"][1]["name"], "wide");
  EXPECT_EQ(json["views"][1]["skipped"], 1);
  EXPECT_EQ(json["views"][1]["latency"]["p99_ms"], 9);
  EXPECT_EQ(json["threads"][0]["name"], "pipeline");
  EXPECT_NEAR(json["threads"][0]["load"].get<double>(), 0.4, 1e-9);
  EXPECT_EQ(json["cameras"][0]["dropped"], 2);
  EXPECT_EQ(json["memory_mib"]["peak"], 130);
  EXPECT_TRUE(json["memory_mib"]["locked"].is_null()) << "the kernel does not say";
}

TEST(BenchText, EndsWithTheVerdict) {
  const BenchFigures figures = some_figures();
  const Verdict verdict = judge(figures);
  const std::string text = bench_text(figures, verdict);
  EXPECT_TRUE(text.ends_with("\n" + verdict.sentence + "\n")) << text;
  for (const char* part : {"camera front: nv12 1920x1080 at 30, 2 frames not used", "measurement",
                           "wide", "worker 1", "40.0", "resident 120.0, at most 130.0"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  }
}

TEST(Percentiles, AreThoseOfTheSamples) {
  std::vector<float> samples;
  EXPECT_EQ(percentiles(samples).p99, 0);
  for (int i = 1000; i >= 1; --i) samples.push_back(static_cast<float>(i));
  EXPECT_NEAR(percentiles(samples).p50, 500, 1);
  EXPECT_NEAR(percentiles(samples).p99, 990, 1);
}

}  // namespace
}  // namespace orbwatch::app::cli
