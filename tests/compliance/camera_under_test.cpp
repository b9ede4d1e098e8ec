// SPDX-License-Identifier: Apache-2.0
#include "tests/compliance/camera_under_test.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <variant>

#include "app/daemon/site/cameras.h"
#include "app/files/text/text_file.h"
#include "app/files/toml/toml_reader.h"

namespace orbwatch::tests {
template <class Visitor>
void visit(Visitor& v, ComplianceSettings& settings) {
  int most_frames = static_cast<int>(settings.most_frames);
  v.optional("most_frames", most_frames, Range::between(2, 89), "Per case");
  settings.most_frames = static_cast<std::size_t>(most_frames);
  v.optional("counts_all", settings.counts_all, "Frames without a buffer have a number, too");
  v.optional("unplug", settings.unplug, "Shell command that takes the camera away");
  v.optional("replug", settings.replug, "Shell command that brings it back");
  v.tables("camera", settings.cameras, 1, 2, "The camera, and another one");
}

namespace {

void execute(const std::string& command) { ASSERT_EQ(std::system(command.c_str()), 0) << command; }

}  // namespace

std::optional<CameraUnderTest> CameraUnderTest::instance_;

Result<> CameraUnderTest::load(const std::filesystem::path& file) {
  const auto text = app::files::TextFiles().read(file, "a TOML file");
  if (!text) return tl::unexpected(text.error());
  app::files::Finding finding;
  finding.file = file.string();
  finding.folder = file.parent_path();
  ComplianceSettings settings;
  app::files::read_toml(*text, settings, finding);
  if (finding.message) return fail(*finding.message);
  instance_ = CameraUnderTest(std::move(settings));
  return {};
}

const CameraUnderTest& CameraUnderTest::get() { return instance_.value(); }

std::unique_ptr<hal::Camera> CameraUnderTest::make(const app::files::CameraSettings& settings) {
  static const auto machine = app::simulation::Machine::make({}, hal::Clock::now()).value();
  return app::daemon::make_camera(settings, machine);
}

hal::StreamRequest CameraUnderTest::request(const app::files::CameraSettings& settings) {
  return settings.stream;
}

bool CameraUnderTest::is_scripted() const {
  const hal::CameraOrigin origin = app::files::facts_of(settings_.cameras.front().back_end).origin;
  return origin == hal::CameraOrigin::Process || origin == hal::CameraOrigin::Files;
}

std::unique_ptr<hal::Camera> CameraUnderTest::make_unpluggable() const {
  app::files::CameraSettings settings = settings_.cameras.front();
  if (is_scripted()) settings.faults = {{hal::Fault::Unplugged, 5, 15}};
  return make(settings);
}

void CameraUnderTest::unplug() const {
  if (!is_scripted()) execute(settings_.unplug);
}

void CameraUnderTest::replug() const {
  if (!is_scripted()) execute(settings_.replug);
}

}  // namespace orbwatch::tests
