// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "app/alignment/alignment_desk.h"
#include "app/alignment/work_bound.h"
#include "app/alignment/work_distance.h"
#include "tests/app/alignment/installed_machine.h"
#include "tests/support/error_distribution.h"
#include "tests/support/share.h"

/// The error at the work piece that each method states, compared with the true one, by the commands
/// that the page gives.
namespace orbwatch::app::tests {
namespace {

using orbwatch::tests::ErrorDistribution;
using orbwatch::tests::share_of;

constexpr int kRigs = 20;
constexpr std::size_t kPoints = 7;
/// Standard deviation of a click at a corner: a pixel of the screen, and what the picture resolves;
/// px.
constexpr std::array kHandPx{1.0, 0.5};

/// The record of a site that restarts at once.
class RestartedSite : public AcceptedAlignments {
 public:
  explicit RestartedSite(AlignedSite& site) : site_(site) {}
  Result<int> add(CalibrationEntry entry) override {
    entry.number = ++count_;
    return apply(entry.alignment, site_.rig).map([&] {
      site_.alignments.push_back(entry);
      return count_;
    });
  }
  Result<std::optional<CalibrationEntry>> before(const std::string& /*camera*/) const override {
    return std::optional<CalibrationEntry>();
  }
  bool is_young(const std::string& /*camera*/, std::chrono::minutes /*age*/) const override {
    return false;
  }

 private:
  AlignedSite& site_;
  int count_ = 0;
};

/// Errors at the work piece, stated by a proposal and true; mm.
struct Judged {
  double stated = 0;
  double error = 0;
};

/// An installer with the page in front of a wrong machine.
class Installer {
 public:
  explicit Installer(std::uint64_t seed)
      : random_(seed), machine_(seed), watch_(machine_, seed), accepted_(site_) {
    site_.rig = machine_.stated();
    for (std::size_t n = 0; n < site_.rig.cameras.size(); ++n) {
      site_.cameras.push_back({site_.rig.cameras[n].name, n, {}});
    }
    const optics::Vec3 towards = machine_.work_piece() - site_.rig.ball.centre;
    optics::ViewSpec view;
    view.orientation = {optics::degrees(std::atan2(towards.x, towards.y)),
                        optics::degrees(std::asin(towards.z / norm(towards))), 0};
    view.h_fov = 80;
    view.width = 640;
    view.height = 480;
    site_.work_distance = work_distance(site_.rig, std::array{view});
    restart();
  }

  /// Each returns nullopt when the method refuses.
  std::optional<Judged> find_ball(std::size_t camera) {
    desk_->detect(camera);
    return judged(camera);
  }
  std::optional<Judged> register_to_first(std::size_t camera) {
    desk_->register_to_first(camera);
    return judged(camera);
  }
  std::optional<Judged> place(std::size_t camera) {
    std::normal_distribution<double> hand(0, kHandPx.at(camera));
    for (const ShownPoint& corner : machine_.corners(camera, kPoints, random_)) {
      const double u = corner.pixel.u + hand(random_), v = corner.pixel.v + hand(random_);
      if (desk_->pick(camera, {u, v}) != CommandResult::Done) continue;  // beside the ball
      desk_->mark(camera, corner.point);
      ended(camera);
    }
    desk_->place(camera);
    return judged(camera);
  }
  void undo(std::size_t camera) { EXPECT_EQ(desk_->undo(camera), CommandResult::Done); }
  void accept(std::size_t camera) {
    ASSERT_EQ(desk_->accept(camera), CommandResult::Done) << desk_->report(camera).refusal;
    restart();
  }

 private:
  void restart() {
    desk_.reset();
    desk_.emplace(
        site_, watch_, accepted_, [] {}, [](const auto&) { return Result<>(); });
  }
  AlignmentReport ended(std::size_t camera) {
    AlignmentReport report = desk_->report(camera);
    while (report.state == ProposalState::Working) {
      std::this_thread::yield();
      report = desk_->report(camera);
    }
    return report;
  }
  std::optional<Judged> judged(std::size_t camera) {
    const AlignmentReport report = ended(camera);
    if (report.state != ProposalState::Ready) {
      std::printf("refused: %s\n", report.refusal.c_str());
      return std::nullopt;
    }
    const optics::Vec3 right = machine_.work_piece() - site_.rig.ball.centre;
    const auto shown = desk_->direction(camera, machine_.seen_at(camera, machine_.work_piece()));
    const double error =
        shown ? norm(right) * std::atan2(norm(cross(*shown, right)), dot(*shown, right)) : HUGE_VAL;
    std::printf("%s: %s; true %.2f mm\n", report.proposed->method.c_str(),
                report.proposed->quality.c_str(), error);
    return Judged{work_bound(report.proposed->work_sigma), error};
  }

  std::mt19937_64 random_;
  InstalledMachine machine_;
  RenderedCameras watch_;
  AlignedSite site_;
  RestartedSite accepted_;
  std::optional<AlignmentDesk> desk_;
};

/// Errors that one method stated about all rigs.
struct Statements {
  explicit Statements(const std::string& method)
      : errors(method + ", at the work piece, mm"), shares(method + ", true / stated") {}

  void add(const std::optional<Judged>& judged) {
    if (!judged) {
      ++refused;
      return;
    }
    errors.add(judged->error);
    shares.add(judged->error / judged->stated);
    covered += judged->error <= judged->stated ? 1 : 0;
  }
  void expect(int rigs) const {
    errors.report();
    shares.report();
    std::printf("%d covered, %d refused\n", covered, refused);
    EXPECT_LE(refused, rigs / 20);
    EXPECT_GE(covered + refused, rigs - rigs / 20) << "of " << rigs;
  }

  ErrorDistribution errors, shares;
  int covered = 0;
  int refused = 0;
};

TEST(StatedErrorGate, CoversTheTrueErrorAtTheWorkPieceIn19Of20Rigs) {
  const int rigs = share_of(kRigs);
  constexpr std::size_t kColour = InstalledMachine::kColour, kThermal = InstalledMachine::kThermal;
  Statements colour("colour camera placed"), thermal("thermal camera placed"),
      registered("registered");
  for (int n = 0; n < rigs; ++n) {
    Installer installer(35'000 + static_cast<std::uint64_t>(n));
    ASSERT_TRUE(installer.find_ball(kColour)) << "rig " << n;
    colour.add(installer.place(kColour));
    installer.accept(kColour);
    ASSERT_TRUE(installer.find_ball(kThermal)) << "rig " << n;
    const auto found = installer.register_to_first(kThermal);
    registered.add(found);
    installer.undo(kThermal);
    thermal.add(installer.place(kThermal));
  }
  colour.expect(rigs);
  thermal.expect(rigs);
  registered.expect(rigs);
}

}  // namespace
}  // namespace orbwatch::app::tests
