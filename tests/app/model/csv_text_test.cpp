// SPDX-License-Identifier: Apache-2.0
#include "app/model/csv_text.h"

#include <gtest/gtest.h>

#include <charconv>
#include <limits>
#include <string>

namespace orbwatch::app::tests {
namespace {

TEST(CsvField, IsInQuotationMarksWhereItSeparatesFieldsOrLines) {
  EXPECT_EQ(csv_field("melt pool"), "melt pool");
  EXPECT_EQ(csv_field(""), "");
  EXPECT_EQ(csv_field("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_field("a\nb"), "\"a\nb\"");
  EXPECT_EQ(csv_field("a\rb"), "\"a\rb\"");
  EXPECT_EQ(csv_field("3\" pipe"), "\"3\"\" pipe\"");
}

TEST(CsvNumber, IsReadBackUnchanged) {
  for (const double value : {0.0, -1.5, 1.0 / 3.0, 5e-324, std::numeric_limits<double>::max()}) {
    const std::string text = csv_number(value);
    double read = 0;
    std::from_chars(text.data(), text.data() + text.size(), read);
    EXPECT_EQ(read, value) << text;
  }
  EXPECT_EQ(csv_number(0.1), "0.1");
  EXPECT_EQ(csv_number(std::numeric_limits<double>::quiet_NaN()), "");
}

}  // namespace
}  // namespace orbwatch::app::tests
