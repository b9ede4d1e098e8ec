// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/model/status/status.h"
#include "hal/clock.h"
#include "proc/align/work_progress.h"
#include "proc/image/result.h"
#include "proc/optics/ball_projection.h"
#include "proc/optics/rotation.h"
#include "proc/optics/view_projection.h"

namespace orbwatch::app {

/// Reflection of a straight edge of the scene in a camera's ball.
struct SceneEdge {
  optics::Vec3 from;  ///< its ends: from the ball's centre along the machine's axes, mm
  optics::Vec3 to;
  std::vector<optics::Vec2> pixels;  ///< from end to end, in the camera's picture
};

/// Reflection of a corner of the scene in a camera's ball.
struct SceneCorner {
  optics::Vec3 point;  ///< machine frame, mm
  optics::Vec2 pixel;  ///< in the camera's picture
};

/// Alignment of one camera.
struct CameraAlignmentState {
  optics::Outline outline;               ///< the ball's outline, px
  optics::YawPitchRoll rotation;         ///< registration to the machine frame, degrees
  std::optional<optics::Vec3> position;  ///< camera position, machine frame, mm; nullopt: unknown
  int number = 0;       ///< number of the accepted alignment; 0: the rig file's, or not accepted
  std::string method;   ///< method by which it was found
  std::string quality;  ///< text about its errors
  double direction_sigma = signals::kNotValid;  ///< degrees
  double work_sigma = signals::kNotValid;       ///< error at the work piece, mm
  std::vector<SceneEdge> edges{};               ///< edges visible from the ball's centre
  std::vector<SceneCorner> corners{};           ///< ends of edges that are, each once
};

/// A known point for camera placement.
struct PlacedPoint {
  optics::Vec3 point;                      ///< machine frame, mm
  optics::Vec2 pixel;                      ///< marked position in the picture, px
  std::optional<optics::Vec2> residual{};  ///< px, marked minus projected; set by the placement
  bool is_outlier = false;                 ///< contradicts the others
};

/// State of one camera's alignment, for interfaces.
struct AlignmentReport {
  int width = 0;  ///< picture width, px
  int height = 0;
  bool is_watched = false;  ///< required for pictures and commands
  std::optional<CameraAlignmentState> in_force;
  std::optional<CameraAlignmentState> proposed;
  ProposalState state = ProposalState::None;
  align::WorkStep step = align::WorkStep::None;  ///< of what is being computed
  double share = 0;                              ///< part of the step that is done: 0 to 1
  std::string refusal;    ///< reason of the last command's failure; empty: it succeeded
  std::size_t steps = 0;  ///< changes that undo_alignment can undo
  std::optional<optics::Vec2> picked;  ///< pixel set by pick_pixel for the next mark_point
  std::vector<PlacedPoint> points;
};

/// Request for a picture from which a user judges an alignment, or for a pair.
struct AlignmentPicture {
  std::size_t camera = 0;
  /// Requested view; nullopt: the camera's whole picture.
  std::optional<optics::ViewSpec> view;
  bool is_proposed = false;                      ///< use the proposed alignment, if there is one
  std::optional<optics::BallModel::Kind> model;  ///< replaces the rig's model
  /// Also requests the same view from the first camera, by its alignment in force.
  bool is_beside_first = false;
  /// Sides of the whole picture, px, none above the camera's; 0: the camera's own.
  int width = 0, height = 0;
};

/// JPEG files of frames of one set. One-channel pictures are stretched: black is the 1st, white the
/// 99th percentile of their values.
struct AlignmentJpegs {
  hal::TimePoint stamp;            ///< the set's
  std::vector<std::string> files;  ///< of a pair, the first camera's comes first
};

/// Queries of interfaces about alignments, besides figures and commands. Thread-safe.
class AlignmentSource {
 public:
  /// Called once, on another thread.
  using OnPictures = std::function<void(Result<AlignmentJpegs>)>;
  /// Returns whether the client still waits for the picture. Called on any thread, also under a
  /// lock. Once false it stays false, and OnPictures need not be called.
  using IsWanted = std::function<bool()>;

  virtual ~AlignmentSource() = default;
  virtual AlignmentReport report(std::size_t camera) const = 0;
  /// Direction of a pixel of the camera's picture, by the proposed alignment or, without one, by
  /// the alignment in force: a unit vector from the ball's centre, machine frame. Nullopt: the
  /// pixel is not on the ball.
  virtual std::optional<optics::Vec3> direction(std::size_t camera,
                                                const optics::Vec2& pixel) const = 0;
  /// Requests a picture made from the camera's next frame, or a pair made from the next frame set
  /// that has a new one of both cameras; does not wait. Error: a camera is not watched or has a
  /// fault, too many pictures of it are requested, the alignment is impossible with this model, or
  /// the first camera is to be compared with itself. While the camera of a single picture delivers
  /// nothing, `on_pictures` is not called.
  virtual Result<> request(const AlignmentPicture& picture, OnPictures on_pictures,
                           IsWanted is_wanted) = 0;
};

}  // namespace orbwatch::app
