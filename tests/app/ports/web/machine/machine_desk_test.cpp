// SPDX-License-Identifier: Apache-2.0
// States of the machine that scripts send, over the server.
#include <gmock/gmock.h>

#include <atomic>
#include <cmath>
#include <mutex>
#include <nlohmann/json.hpp>
#include <vector>

#include "tests/app/ports/web/served.h"

namespace orbwatch::app::web::tests {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class MachineStates : public Served {
 protected:
  void serve(MachineSource source) {
    WebContext context = make_context();
    context.machine = {source,
                       [this](const MachineState& state) -> Result<> {
                         if (auto checked = check(state); !checked) return checked;
                         const std::lock_guard lock(mutex_);
                         states_.push_back(state);
                         return {};
                       },
                       [this](const Error&) { ++refused_; }};
    sink = std::make_unique<WebSink>(on_a_free_port(), context);
    ASSERT_TRUE(sink->start());
  }
  Answer post(const std::string& body) const {
    return request(port(), "POST", "/api/v1/machine_state", kJsonHeader, body);
  }
  std::vector<MachineState> states() const {
    const std::lock_guard lock(mutex_);
    return states_;
  }
  int refused() const { return refused_; }

 private:
  std::atomic<int> refused_{0};
  mutable std::mutex mutex_;
  std::vector<MachineState> states_;
};

TEST_F(MachineStates, EveryValueArrivesUnderItsName) {
  serve(MachineSource::Http);
  json body{{"sequence", 5}, {"clock", 12.5}, {"part", "Flügel 7"}};
  for (const MachineValue& value : kMachineValues) {
    body[std::string(value.name)] = value.maximum;
  }
  const Answer answer = post(body.dump());
  ASSERT_EQ(answer.status, 200) << answer.body;
  ASSERT_EQ(states().size(), 1U);
  const MachineState state = states().front();
  EXPECT_EQ(state.sequence, 5U);
  EXPECT_EQ(state.clock, 12.5);
  EXPECT_EQ(state.part.text(), "Flügel 7");
  for (const MachineValue& value : kMachineValues) {
    EXPECT_EQ(state.values.*value.get, value.maximum) << value.name;
  }
}

TEST_F(MachineStates, WhatIsLeftOutIsNotKnown) {
  serve(MachineSource::Http);
  ASSERT_EQ(post(R"({"layer": 3})").status, 200);
  const MachineState state = states().front();
  EXPECT_EQ(state.sequence, std::nullopt);
  EXPECT_TRUE(std::isnan(state.clock));
  EXPECT_TRUE(std::isnan(state.values.x));
  EXPECT_EQ(state.values.layer, 3);
}

TEST_F(MachineStates, WhatIsWrongIsRefusedByName) {
  serve(MachineSource::Http);
  const std::pair<const char*, const char*> refusals[] = {
      {R"({"layer": 2.5})", "layer is 2.5"},
      {R"({"layer": -1})", "layer is -1"},
      {R"({"laser_on": 2})", "laser_on is 2"},
      {R"({"x": "far"})", "x must be"},
      {R"({"part": "123456789012345678901234567890123"})", "part has 33 bytes"},
      {R"({"sequence": 4294967296})", "sequence is"},
      {R"({"speed": 1})", "unknown member"},
  };
  for (const auto& [body, reason] : refusals) {
    const Answer answer = post(body);
    EXPECT_EQ(answer.status, 400) << body;
    EXPECT_THAT(answer.body, HasSubstr(reason)) << body;
  }
  // The handler itself counts what it refuses: a number that is not whole.
  EXPECT_EQ(refused(), static_cast<int>(std::size(refusals)) - 1);
  EXPECT_TRUE(states().empty());
}

TEST_F(MachineStates, AnotherSourceIsNamed) {
  serve(MachineSource::Modbus);
  const Answer answer = post(R"({"layer": 3})");
  EXPECT_EQ(answer.status, 409);
  EXPECT_THAT(answer.body, HasSubstr("taken from source modbus"));
  EXPECT_TRUE(states().empty());
}

}  // namespace
}  // namespace orbwatch::app::web::tests
