// SPDX-License-Identifier: Apache-2.0
#include "app/cli/doctor/doctor_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/cli/equal_json.h"

namespace orbwatch::app::cli::doctor {
namespace {

using tests::expect_equal_json;

Diagnosis named(std::string check, Diagnosis diagnosis) {
  diagnosis.check = std::move(check);
  return diagnosis;
}

const Diagnoses kThree{named("kernel", ok("Linux 6.12")),
                       named("clock", warning("no battery clock", "fit one")),
                       named("lines", fault("out: used", "end it"))};

TEST(DoctorText, IsALineForEachFinding) {
  EXPECT_EQ(doctor_table(kThree),
            "  level    check   finding\n"
            "  ok       kernel  Linux 6.12\n"
            "  warning  clock   no battery clock. Remedy: fit one\n"
            "  fault    lines   out: used. Remedy: end it\n"
            "\n"
            "1 fault, 1 warning\n");
}

TEST(DoctorText, AsJson) {
  expect_equal_json(doctor_json(kThree), R"({"worst": "fault", "checks": [
    {"check": "kernel", "level": "ok", "text": "Linux 6.12", "remedy": ""},
    {"check": "clock", "level": "warning", "text": "no battery clock", "remedy": "fit one"},
    {"check": "lines", "level": "fault", "text": "out: used", "remedy": "end it"}]})");
  expect_equal_json(doctor_json({}), R"({"worst": "ok", "checks": []})");
}

TEST(DoctorText, BearsWhateverDevicesSay) {
  const Diagnoses odd{named("board", ok("\x1b[2J\n\xff\"\\"))};
  EXPECT_THAT(doctor_table(odd), testing::HasSubstr("?[2J?\xff\"\\\n"));
  expect_equal_json(doctor_json(odd), R"({"worst": "ok", "checks": [
    {"check": "board", "level": "ok", "text": "\u001b[2J\n\ufffd\"\\", "remedy": ""}]})");
}

TEST(DoctorText, TheWorstCounts) {
  EXPECT_EQ(worst({}), Level::Ok);
  EXPECT_EQ(worst({ok("a"), warning("b", "c")}), Level::Warning);
  EXPECT_EQ(worst(kThree), Level::Fault);
  EXPECT_EQ(summary({}), "0 faults, 0 warnings");
}

}  // namespace
}  // namespace orbwatch::app::cli::doctor
