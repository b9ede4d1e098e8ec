#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/model/status.h"
#include "proc/image/result.h"
#include "proc/optics/ball_projection.h"
#include "proc/optics/rotation.h"
#include "proc/optics/view_projection.h"

namespace orbwatch::app {

/// What a camera's ball shows of a straight edge of the scene.
struct SceneEdge {
  optics::Vec3 from;  ///< its ends: from the ball's centre along the machine's axes, mm
  optics::Vec3 to;
  std::vector<optics::Vec2> pixels;  ///< from end to end, in the camera's picture
};

/// How one camera is aligned.
struct CameraAlignmentState {
  optics::Outline outline;               ///< of the ball, px
  optics::YawPitchRoll rotation;         ///< registration to the machine frame, degrees
  std::optional<optics::Vec3> position;  ///< of the camera, machine frame, mm, if it is known
  int number = 0;       ///< of the accepted alignment; 0: as the rig file has it, or not accepted
  std::string method;   ///< how it was found
  std::string quality;  ///< what is known of its errors
  double direction_sigma = signals::kNotValid;  ///< degrees
  std::vector<SceneEdge> edges{};               ///< those that the ball's centre sees
};

/// A known point that a camera is placed by.
struct PlacedPoint {
  optics::Vec3 point;                      ///< machine frame, mm
  optics::Vec2 pixel;                      ///< where it was marked
  std::optional<optics::Vec2> residual{};  ///< px, marked minus shown, since it was placed
  bool is_outlier = false;                 ///< contradicts the others
};

/// What is known of one camera's alignment.
struct AlignmentReport {
  int width = 0;  ///< px, of the camera's pictures
  int height = 0;
  bool is_watched = false;  ///< pictures and commands need that
  std::optional<CameraAlignmentState> in_force;
  std::optional<CameraAlignmentState> proposed;
  ProposalState state = ProposalState::None;
  std::string refusal;                 ///< why the command given last found nothing; empty: it did
  std::size_t steps = 0;               ///< how often undo_alignment can take something back
  std::optional<optics::Vec2> picked;  ///< by pick_pixel, for the next mark_point
  std::vector<PlacedPoint> points;
};

/// A picture that an alignment is judged by.
struct AlignmentPicture {
  std::size_t camera = 0;
  /// What it shows; nullopt: what the camera sees, pixel by pixel.
  std::optional<optics::ViewSpec> view;
  bool is_proposed = false;                      ///< by the proposed alignment, if there is one
  std::optional<optics::BallModel::Kind> model;  ///< instead of the rig's
};

/// What interfaces may ask about alignments, besides figures and commands. Thread-safe.
class AlignmentSource {
 public:
  /// Called once, on another thread: the JPEG file.
  using OnPicture = std::function<void(Result<std::string>)>;
  /// Called on any thread, also under a lock: somebody still waits for that. False for ever once it
  /// was false; then OnPicture need not be called.
  using IsWanted = std::function<bool()>;

  virtual ~AlignmentSource() = default;
  virtual AlignmentReport report(std::size_t camera) const = 0;
  /// Where that lies which the camera's picture shows at a pixel, by the proposed alignment or, if
  /// there is none, by that in force: a unit vector from the ball's centre, machine frame. Nullopt:
  /// the ball is elsewhere.
  virtual std::optional<optics::Vec3> direction(std::size_t camera,
                                                const optics::Vec2& pixel) const = 0;
  /// Of the camera's next picture; does not wait. Of 16 bit luminance the range that is there is
  /// stretched to 8. Error: the camera is not watched or has a fault, too many of its pictures are
  /// asked for, an alignment that is impossible with this model. While the camera delivers nothing,
  /// `on_picture` is not called.
  virtual Result<> request(const AlignmentPicture& picture, OnPicture on_picture,
                           IsWanted is_wanted) = 0;
};

}  // namespace orbwatch::app
