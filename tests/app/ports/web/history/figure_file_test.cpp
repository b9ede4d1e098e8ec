// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/history/figure_file.h"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <tuple>

#include "tests/app/ports/dds/test_status.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app::web::tests {
namespace {

using app::tests::kRecipe;
using testing::HasSubstr;

constexpr auto kStep = FigureHistory::kStep;
const Component kEdge{"region", "edge"}, kColour{"camera", "colour"};

/// A history that ended some time ago, and the file of it.
class FigureFile : public testing::Test {
 protected:
  static void measure(FigureHistory& history, double width) {
    Status status;
    status.recipe = kRecipe;
    status.region_count = 2;
    status.regions[1].signals.hot_spot_width = width;
    status.camera_count = 1;
    status.cameras[0].blur = width / 2;
    history.accept(status);
  }
  /// Writes two measured steps, of which the last one ended `age` ago.
  void write(std::chrono::nanoseconds age) const {
    FigureHistory history(names);
    hal::TimePoint end = hal::Clock::now() - age - 2 * kStep;
    history.advance(end);
    for (const double width : {3.0, 4.0}) {
      measure(history, width);
      history.advance(end += kStep);
    }
    const auto written = write_figures(file, history);
    ASSERT_TRUE(written) << written.error().message;
  }
  std::string text() const {
    std::ostringstream read;
    read << std::ifstream(file, std::ios::binary).rdbuf();
    return read.str();
  }
  /// The file's text with another value of a key of its head.
  static std::string with(std::string text, const std::string& key, const std::string& value) {
    const std::size_t begin = text.find("\"" + key + "\":") + key.size() + 3;
    const std::string quote = text[begin] == '"' ? "\"" : "";
    return text.replace(begin, text.find_first_of(",}", begin) - begin, quote + value + quote);
  }
  /// Reason why a file with this text is left out; "accepted": it is continued, with so many
  /// components.
  std::string refusal(const std::string& content, bool is_utc_certain = true,
                      std::size_t components = 0) const {
    std::ofstream(file, std::ios::binary | std::ios::trunc) << content;
    FigureHistory history(names);
    const auto resumed = resume_figures(file, history, is_utc_certain);
    EXPECT_EQ(history.components().size(), components);
    return resumed ? "accepted" : resumed.error().message;
  }

  const StatusNames names = app::tests::make_names();
  const orbwatch::tests::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "figure-history";
};

TEST_F(FigureFile, IsContinuedBehindAGap) {
  write(std::chrono::seconds(5));
  FigureHistory history(names);
  const auto resumed = resume_figures(file, history);
  ASSERT_TRUE(resumed) << resumed.error().message;
  const hal::TimePoint end = history.series(kEdge, "hot_spot_width")->end;
  measure(history, 7);
  history.advance(end + kStep);
  for (const auto& [component, figure, scale] :
       {std::tuple{kEdge, "hot_spot_width", 1.0}, std::tuple{kColour, "blur", 0.5}}) {
    const auto steps = history.series(component, figure)->steps;
    ASSERT_GE(steps.size(), 2U + 9U + 1U) << "5 s are ten steps, the last one not over";
    EXPECT_EQ(steps[0].low, 3 * scale);
    EXPECT_EQ(steps[1].high, 4 * scale);
    for (std::size_t n = 2; n + 1 < steps.size(); ++n) EXPECT_TRUE(std::isnan(steps[n].low)) << n;
    EXPECT_EQ(steps.back().high, 7 * scale);
  }
}

TEST_F(FigureFile, OlderThanAllStepsIsForgotten) {
  write(kStep * FigureHistory::kSteps);
  FigureHistory history(names);
  EXPECT_TRUE(resume_figures(file, history));
  EXPECT_TRUE(history.components().empty());
}

TEST_F(FigureFile, WithoutOneTheHistoryIsNew) {
  FigureHistory history(names);
  EXPECT_TRUE(resume_figures(file, history));
  EXPECT_TRUE(history.components().empty());
}

TEST_F(FigureFile, IsReadableByItsOwnerOnly) {
  write({});
  EXPECT_EQ(std::filesystem::status(file).permissions(), std::filesystem::perms(0600));
}

TEST_F(FigureFile, ThatIsDamagedIsRefused) {
  write({});
  const std::string right = text();
  const std::size_t line = right.find('\n') + 1;
  EXPECT_THAT(refusal(""), HasSubstr("its first line is not JSON"));
  EXPECT_THAT(refusal("{}"), HasSubstr("boot is missing"));
  EXPECT_THAT(refusal(right.substr(0, line)), HasSubstr("is damaged"));
  EXPECT_THAT(refusal(right.substr(0, right.size() - 1)), HasSubstr("is damaged"));
  EXPECT_THAT(refusal(right + "x"), HasSubstr("is damaged"));
  const std::string later = with(with(right, "boot", "another"), "end", "9000000000000000000");
  EXPECT_THAT(refusal(later), HasSubstr("ends in the future"));
}

TEST_F(FigureFile, WithinABootIsContinuedAlthoughUtcWasCorrected) {
  write(std::chrono::seconds(5));
  EXPECT_EQ(refusal(with(text(), "end", "9000000000000000000"), false, 3), "accepted");
}

TEST_F(FigureFile, OfBeforeThisBootWaitsForTheTimeServer) {
  write(std::chrono::seconds(5));
  const std::string before = with(text(), "boot", "another");
  EXPECT_THAT(refusal(before, false), HasSubstr("no time server has set the clock yet"));
  EXPECT_EQ(refusal(before, true, 3), "accepted");
}

}  // namespace
}  // namespace orbwatch::app::web::tests
