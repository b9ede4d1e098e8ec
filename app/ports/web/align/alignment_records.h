// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "app/model/alignment/alignment.h"
#include "proc/image/picture.h"
#include "proc/optics/ball_model.h"
#include "proc/settings/settings.h"

/// Records of alignments. Pixels are [u, v]: to the right and down, pixel centres at integers.
namespace orbwatch::app::web {

template <class Visitor>
void visit(Visitor& v, optics::Outline& outline) {
  v.required("u", outline.centre.u, "Centre, to the right", "px");
  v.required("v", outline.centre.v, "Centre, down", "px");
  v.required("rx", outline.rx, "Half axis", "px");
  v.required("ry", outline.ry, "Half axis across rx", "px");
  v.required("angle", outline.angle, "Angle of the rx axis, from u towards v", "deg");
}

template <class Visitor>
void visit(Visitor& v, optics::YawPitchRoll& angles) {
  v.required("yaw", angles.yaw, "From +Y towards +X", "deg");
  v.required("pitch", angles.pitch, "Up positive", "deg");
  v.required("roll", angles.roll, "Positive lowers the right side", "deg");
}

template <class Visitor>
void visit(Visitor& v, SceneEdge& edge) {
  v.required("from", edge.from, "First end, from the ball's centre, machine axes", "mm");
  v.required("to", edge.to, "Second end", "mm");
  v.required("pixels", edge.pixels, "Edge in the camera's picture, from end to end", "px");
}

template <class Visitor>
void visit(Visitor& v, SceneCorner& corner) {
  v.required("point", corner.point, "Corner, machine frame", "mm");
  v.required("pixel", corner.pixel, "Corner in the camera's picture", "px");
}

template <class Visitor>
void visit(Visitor& v, CameraAlignmentState& state) {
  v.required("outline", state.outline, "The ball's outline in the picture");
  v.required("rotation", state.rotation, "Registration to the machine frame");
  v.required("position", state.position, "Position of the camera; null: unknown", "mm");
  v.required("number", state.number,
             "Number of the accepted alignment; 0: the rig file's, or none");
  v.required("method", state.method, "Method by which it was found");
  v.required("quality", state.quality, "Its errors in words");
  v.required("direction_sigma", state.direction_sigma, "Standard error of directions", "deg");
  v.required("work_sigma", state.work_sigma,
             "Standard error at the work piece, which is the stated scene in the middle of the "
             "measured view; null: not known",
             "mm");
  v.required("edges", state.edges, "Edges of the scene that are visible from the ball's centre");
  v.required("corners", state.corners, "Ends of edges that are visible from there, each once");
}

template <class Visitor>
void visit(Visitor& v, PlacedPoint& point) {
  v.required("point", point.point, "Known point, machine frame", "mm");
  v.required("pixel", point.pixel, "Marked position in the picture", "px");
  v.required("residual", point.residual, "Marked minus projected; null: not placed yet", "px");
  v.required("is_outlier", point.is_outlier, "It contradicts the other points");
}

/// Alignment of one camera.
struct SentAlignment {
  std::string name;
  std::size_t index = 0;
  AlignmentReport report;
};
template <class Visitor>
void visit(Visitor& v, SentAlignment& camera) {
  AlignmentReport& report = camera.report;
  v.required("name", camera.name, "Name of the camera");
  v.required("index", camera.index, "Argument camera of commands");
  v.required("width", report.width, "Width of the camera's picture", "px");
  v.required("height", report.height, "Height of the camera's picture", "px");
  v.required("is_watched", report.is_watched, "Pictures and commands are possible");
  v.required("state", report.state, "State of the proposal");
  v.required("step", report.step, "Step of the computation, while the state is working");
  v.required("share", report.share, Range::between(0, 1), "Part of the step that is done");
  v.required("refusal", report.refusal, "Reason why the last command failed; empty: it succeeded");
  v.required("steps", report.steps, "Number of changes that undo_alignment can undo");
  v.required("in_force", report.in_force, "Alignment in force; null: none");
  v.required("proposed", report.proposed, "Proposed alignment; null: none");
  v.required("picked", report.picked, "Pixel for the next mark_point; null: none", "px");
  v.required("points", report.points, "Known points that are marked");
}

struct AlignmentAnswer {
  std::vector<SentAlignment> cameras;
};
template <class Visitor>
void visit(Visitor& v, AlignmentAnswer& answer) {
  v.required("cameras", answer.cameras, "All cameras");
}

struct CameraQuery {
  std::string camera;
};
template <class Visitor>
void visit(Visitor& v, CameraQuery& query) {
  v.required("camera", query.camera, "Name of the camera");
}

/// Alignments by which a view is computed; the value: it is the proposed one.
inline constexpr std::array kWhichAlignment{Word{"in_force", false}, Word{"proposed", true}};
/// Limits of a view's sides, px: it is computed for each request.
inline constexpr Range kCameraViewSide = Range::between(16, 1920);

/// A perspective view from one camera.
struct CameraViewQuery : CameraQuery {
  bool is_proposed = false;
  double yaw = 0, pitch = 0, h_fov = 90;
  int width = 480, height = 480;
  std::optional<optics::BallModel::Kind> model;
};
template <class Visitor>
void visit(Visitor& v, CameraViewQuery& query) {
  visit(v, static_cast<CameraQuery&>(query));
  v.optional("which", query.is_proposed, kWhichAlignment, "Alignment to use");
  v.optional("yaw", query.yaw, Range::between(-180, 180), "From +Y towards +X", "deg");
  v.optional("pitch", query.pitch, Range::between(-90, 90), "Up positive", "deg");
  v.optional("h_fov", query.h_fov, Range::between(1, 170), "Horizontal field of view", "deg");
  v.optional("width", query.width, kCameraViewSide, "Width of the picture", "px");
  v.optional("height", query.height, kCameraViewSide, "Height of the picture", "px");
  v.optional("model", query.model, optics::kBallModels, "Model of the ball; default: the rig's");
}

/// A pixel of a camera's picture, which may lie outside of it.
struct CameraPixelQuery : CameraQuery {
  optics::Vec2 pixel;
};
template <class Visitor>
void visit(Visitor& v, CameraPixelQuery& query) {
  const Range place = Range::between(-kMaxSide, kMaxSide);
  visit(v, static_cast<CameraQuery&>(query));
  v.required("u", query.pixel.u, place, "To the right, pixel centres at integers", "px");
  v.required("v", query.pixel.v, place, "Down", "px");
}

struct DirectionAnswer {
  double yaw = 0, pitch = 0;
};
template <class Visitor>
void visit(Visitor& v, DirectionAnswer& answer) {
  v.required("yaw", answer.yaw, "From +Y towards +X", "deg");
  v.required("pitch", answer.pitch, "Up positive", "deg");
}

}  // namespace orbwatch::app::web
