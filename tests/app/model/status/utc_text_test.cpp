// SPDX-License-Identifier: Apache-2.0
#include "app/model/status/utc_text.h"

#include <gtest/gtest.h>

namespace orbwatch::app::tests {
namespace {

using std::chrono::nanoseconds;
using std::chrono::system_clock;

TEST(UtcText, IsParsedToTheMomentThatItWasWrittenFrom) {
  for (const std::uint64_t moment :
       {1ULL, 999'999'999ULL, 951'782'400'000'000'000ULL, 1'795'857'720'125'000'001ULL}) {
    const auto text = utc_text(system_clock::time_point(nanoseconds(moment)));
    ASSERT_TRUE(text);
    EXPECT_EQ(parse_utc_text(*text), moment) << *text;
  }
}

TEST(UtcText, HasAFractionOrNone) {
  EXPECT_EQ(parse_utc_text("1970-01-01T00:00:00Z"), 0U);
  EXPECT_EQ(parse_utc_text("1970-01-02T00:00:01.5Z"), 86'401'500'000'000U);
  EXPECT_EQ(parse_utc_text("2024-02-29T00:00:00Z"), 1'709'164'800'000'000'000U);
}

TEST(UtcText, OfAnotherFormIsNotParsed) {
  for (const char* text :
       {"", "Z", "2026-11-28", "2026-11-28T09:22:00", "2026-11-28 09:22:00Z",
        "2026-11-28T09:22:00.Z", "2026-11-28T09:22:00.1234567890Z", "2026-11-28T09:22:00.-5Z",
        "2026-11-28T09:22:00+01:00", "2026-02-29T00:00:00Z", "2026-13-01T00:00:00Z",
        "1969-12-31T23:59:59Z", "+026-11-28T09:22:00Z", "2026-11-28T24:00:00Z",
        "2026-11-28T09:60:00Z"}) {
    EXPECT_FALSE(parse_utc_text(text)) << text;
  }
}

TEST(UtcText, OfNamesSortsAsMomentsDo) {
  const auto text_at = [](std::int64_t ms) {
    return compact_utc_text(system_clock::time_point(std::chrono::milliseconds(ms)));
  };
  EXPECT_FALSE(text_at(0));
  EXPECT_EQ(text_at(1'795'857'720'125), "20261128T092200.125Z");
  std::string before;
  for (const std::int64_t ms : {1LL, 999LL, 1000LL, 951'782'399'999LL, 1'795'857'720'125LL}) {
    const std::string text = text_at(ms).value_or("");
    EXPECT_EQ(text.size(), kCompactUtcLength);
    EXPECT_TRUE(is_compact_utc_text(text)) << text;
    EXPECT_LT(before, text);
    before = text;
  }
  for (const char* text : {"", "20261128T092200.125", "20261128t092200.125Z",
                           "20261128T092200.125Z-", "2026x128T092200.125Z"}) {
    EXPECT_FALSE(is_compact_utc_text(text)) << text;
  }
}

}  // namespace
}  // namespace orbwatch::app::tests
