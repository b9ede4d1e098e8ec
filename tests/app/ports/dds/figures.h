// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/ports/dds/status/process_state.h"

/// Access to the components and figures of messages, and their comparison.
namespace orbwatch::app::tests {

/// The components of a kind, in their order.
inline std::vector<dds::ComponentMessage> of_kind(const dds::ProcessStateMessage& message,
                                                  std::string_view kind) {
  std::vector<dds::ComponentMessage> found;
  for (const auto& component : std::span(message.components._buffer, message.components._length)) {
    if (component.kind == kind) found.push_back(component);
  }
  return found;
}

/// A figure by its name; fails the test if it is missing.
inline dds::FigureMessage figure(const dds::FigureSequence& figures, std::string_view name) {
  for (const dds::FigureMessage& figure : std::span(figures._buffer, figures._length)) {
    if (figure.name == name) return figure;
  }
  ADD_FAILURE() << "no figure " << name;
  return {};
}
inline double value(const dds::ComponentMessage& component, std::string_view name) {
  return figure(component.figures, name).value;
}

/// All components, in order; ages may have grown by a minute.
inline void expect_same(std::span<const ComponentReadings> actual,
                        std::span<const ComponentReadings> expected) {
  ASSERT_EQ(actual.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const std::string where =
        std::string(expected[i].component.kind) + " " + expected[i].component.name;
    EXPECT_EQ(actual[i].component, expected[i].component) << where;
    ASSERT_EQ(actual[i].readings.size(), expected[i].readings.size()) << where;
    for (std::size_t j = 0; j < expected[i].readings.size(); ++j) {
      const Reading& a = actual[i].readings[j];
      const Reading& e = expected[i].readings[j];
      EXPECT_EQ(a.name, e.name) << where;
      EXPECT_EQ(a.unit, e.unit) << where << ": " << e.name;
      EXPECT_EQ(a.text, e.text) << where << ": " << e.name;
      if (std::isnan(e.value)) {
        EXPECT_TRUE(std::isnan(a.value)) << where << ": " << e.name;
      } else if (e.name.ends_with("_age")) {
        EXPECT_GE(a.value, e.value) << where << ": " << e.name;
        EXPECT_LT(a.value, e.value + 60) << where << ": " << e.name;
      } else {
        EXPECT_EQ(a.value, e.value) << where << ": " << e.name;
      }
    }
  }
}

}  // namespace orbwatch::app::tests
