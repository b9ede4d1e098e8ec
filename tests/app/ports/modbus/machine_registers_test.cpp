// SPDX-License-Identifier: Apache-2.0
// States of the machine as a PLC writes them, by libmodbus.
#include "app/ports/modbus/machine_registers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <mutex>
#include <vector>

#include "app/machine/machine_follower.h"
#include "app/ports/modbus/map/layout.h"
#include "tests/app/ports/modbus/clients.h"

namespace orbwatch::app {
namespace {

using tests::address_of;
using tests::loopback;
using tests::Plc;
using tests::Words;

constexpr int kOutside = 3, kNotServed = 2;

/// States that the sink handed over.
class TakenStates {
 public:
  MachinePath path(MachineSource source = MachineSource::Modbus) {
    return {source, [this](const MachineState& state) -> Result<> {
              const std::lock_guard lock(mutex_);
              if (auto checked = check(state); !checked) return checked;
              states_.push_back(state);
              return {};
            }};
  }
  std::vector<MachineState> states() const {
    const std::lock_guard lock(mutex_);
    return states_;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<MachineState> states_;
};

/// The block of a PLC's state, built as the handbook says.
class Block {
 public:
  Block() : words_(static_cast<std::size_t>(modbus::kWholeMachineState.size())) {
    for (const MachineValue& value : kMachineValues) put(std::string(value.name), 0x80000000);
    put("clock_seconds", 0xffffffff);
  }

  Block& put(const std::string& name, std::uint32_t value) {
    const auto at = static_cast<std::size_t>(address_of("state_" + name) - begin());
    words_[at] = static_cast<std::uint16_t>(value >> 16);
    words_[at + 1] = static_cast<std::uint16_t>(value);
    return *this;
  }
  Block& part(const std::string& text) {
    for (std::size_t i = 0; i < text.size(); ++i) {
      const auto byte = static_cast<unsigned char>(text[i]);
      words_[i / 2] = static_cast<std::uint16_t>(words_[i / 2] | byte << (i % 2 == 0 ? 8 : 0));
    }
    return *this;
  }
  const Words& words() const { return words_; }
  static int begin() { return modbus::kMachineState.begin; }

 private:
  Words words_;
};

class MachineRegisters : public testing::Test {
 protected:
  void start(MachineSource source = MachineSource::Modbus) { start(machine_.path(source)); }
  void start(const MachinePath& path) {
    sink_.emplace(loopback(), tests::accept_all, std::make_shared<CommandRecord>(), path);
    ASSERT_TRUE(sink_->start());
    plc_.emplace(sink_->port());
  }

  TakenStates machine_;
  machine::MachineFollower follower_{{.source = MachineSource::Modbus}};
  std::optional<ModbusSink> sink_;
  std::optional<Plc> plc_;
};

TEST_F(MachineRegisters, AStateArrivesInItsUnits) {
  start();
  const Block block = Block()
                          .part("Flügel 7")
                          .put("sequence", 70000)
                          .put("clock_seconds", 12)
                          .put("clock_microseconds", 345678)
                          .put("layer", 3)
                          .put("x", static_cast<std::uint32_t>(-123456))
                          .put("laser_power", 18005)
                          .put("laser_on", 1);
  ASSERT_EQ(plc_->write(Block::begin(), block.words()), 0);
  ASSERT_EQ(machine_.states().size(), 1U);
  const MachineState state = machine_.states().front();
  EXPECT_EQ(state.part.text(), "Flügel 7");
  EXPECT_EQ(state.sequence, 70000U);
  EXPECT_NEAR(state.clock, 12.345678, 1e-9);
  EXPECT_EQ(state.values.layer, 3);
  EXPECT_NEAR(state.values.x, -123.456, 1e-9);
  EXPECT_NEAR(state.values.laser_power, 1800.5, 1e-9);
  EXPECT_EQ(state.values.laser_on, 1);
  EXPECT_TRUE(std::isnan(state.values.y));
  EXPECT_TRUE(std::isnan(state.values.powder_flow));
  // It reads back as written.
  ASSERT_EQ(plc_->read_holding(Block::begin(), static_cast<int>(block.words().size())), 0);
  EXPECT_EQ(plc_->words, block.words());
}

TEST_F(MachineRegisters, APartOfTheBlockIsRefused) {
  start();
  const Words whole = Block().put("sequence", 1).words();
  const int begin = Block::begin(), count = static_cast<int>(whole.size());
  for (int first = 0; first < count; first += 7) {
    for (int last = first + 1; last < count + 1; last += 5) {
      if (first == 0 && last == count) continue;
      const Words part(whole.begin() + first, whole.begin() + last);
      EXPECT_EQ(plc_->write(begin + first, part), kNotServed) << first << " to " << last;
    }
  }
  EXPECT_EQ(plc_->write(begin, 5), kNotServed);
  EXPECT_EQ(plc_->mask_write(begin, 0, 1), kNotServed);
  Words longer(whole);
  longer.insert(longer.begin(), 2, 0);
  EXPECT_EQ(plc_->write(begin - 2, longer), kNotServed);
  for (const std::size_t more : {1U, 2U, 48U}) {
    longer.assign(whole.begin(), whole.end());
    longer.insert(longer.end(), more, 0);
    EXPECT_EQ(plc_->write(begin, longer), kNotServed) << more << " registers beyond the block";
  }
  EXPECT_TRUE(machine_.states().empty());
}

TEST_F(MachineRegisters, ARefusedStateIsCountedAndChangesNoRegister) {
  start(follower_.path());
  ASSERT_EQ(plc_->write(Block::begin(), Block().put("sequence", 1).put("layer", 4).words()), 0);
  const auto refused = [&](const Block& block) {
    EXPECT_EQ(plc_->write(Block::begin(), block.words()), kOutside);
  };
  refused(Block().put("sequence", 2).put("laser_on", 2));
  refused(Block().put("sequence", 2).put("layer", static_cast<std::uint32_t>(-1)));
  refused(Block().put("sequence", 2).put("x", 100'000'001));
  refused(Block().put("sequence", 2).put("clock_microseconds", 1'000'000));
  refused(Block().put("sequence", 2).part("\xff\xfe"));
  refused(Block().put("sequence", 2).part("line\nbreak"));
  const MachineStatus& machine = follower_.keep(hal::Clock::now());
  EXPECT_EQ(machine.states, 1U);
  EXPECT_EQ(machine.refused, 6U);
  ASSERT_EQ(plc_->read_holding(address_of("state_sequence"), 2), 0);
  EXPECT_EQ(plc_->u32(0), 1U);
}

TEST_F(MachineRegisters, AnotherSourceIsNotOverruled) {
  start(MachineSource::Dds);
  EXPECT_EQ(plc_->write(Block::begin(), Block().put("sequence", 1).words()), kNotServed);
  EXPECT_EQ(plc_->write(Block::begin(), Block().put("laser_on", 2).words()), kNotServed);
  EXPECT_TRUE(machine_.states().empty());
}

TEST_F(MachineRegisters, WritesAndReadsInOneRequest) {
  start();
  Status status;
  status.machine.quality = MachineQuality::Good;
  status.machine.part = *PartName::make("AB");
  status.machine.values.x = 1.5;
  sink_->accept(status);
  const int quality = address_of("machine_quality");
  const int read = quality + modbus::kMirrorOffset;
  const int count = address_of("machine_y") - quality;
  ASSERT_EQ(plc_->write_and_read(Block::begin(), Block().put("sequence", 8).words(), read, count),
            0);
  EXPECT_EQ(machine_.states().size(), 1U);
  EXPECT_EQ(plc_->words[0], 1);
  EXPECT_EQ(plc_->words[static_cast<std::size_t>(address_of("machine_part_0") - quality)], 0x4142);
  EXPECT_EQ(plc_->i32(static_cast<std::size_t>(address_of("machine_x") - quality)), 1500);
  EXPECT_EQ(plc_->u32(static_cast<std::size_t>(address_of("machine_layer") - quality)),
            0x80000000U);
}

TEST_F(MachineRegisters, AResultHasTheMachineOfItsExposure) {
  start();
  Status status;
  status.result = 1;
  status.machine.quality = MachineQuality::Good;
  status.machine.values.layer = 17;
  sink_->accept(status);
  status.machine.values.layer = 18;
  sink_->accept(status);
  ASSERT_EQ(plc_->read_input(address_of("result_machine_layer"), 2), 0);
  EXPECT_EQ(plc_->i32(0), 17);
  ASSERT_EQ(plc_->read_input(address_of("machine_layer"), 2), 0);
  EXPECT_EQ(plc_->i32(0), 18);
}

}  // namespace
}  // namespace orbwatch::app
