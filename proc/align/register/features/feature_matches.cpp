// SPDX-License-Identifier: Apache-2.0
#include "proc/align/register/features/feature_matches.h"

#include <cmath>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

namespace orbwatch::align {
namespace {

constexpr int kMostPerFace = 1500;
constexpr double kContrast = 0.02;  // SIFT's threshold; its default, 0.04, misses dull walls
constexpr double kRatio = 0.85;     // nearest to second-nearest descriptor
constexpr int kEdge = 7;            // px between a feature and the end of the shown part

/// A feature's nearest neighbour among others.
struct Nearest {
  int index = -1;
  float distance = INFINITY;
  float second = INFINITY;
};

std::vector<Nearest> nearest(const cv::Mat& distances, const Features& rows,
                             const Features& columns, double cosine) {
  std::vector<Nearest> best(rows.pixels.size());
  for (std::size_t i = 0; i < best.size(); ++i) {
    const float* const row = distances.ptr<float>(static_cast<int>(i));
    for (std::size_t j = 0; j < columns.pixels.size(); ++j) {
      if (row[j] >= best[i].second) continue;
      if (dot(rows.directions[i], columns.directions[j]) < cosine) continue;
      if (row[j] < best[i].distance) {
        best[i].second = best[i].distance;
        best[i].distance = row[j];
        best[i].index = static_cast<int>(j);
      } else {
        best[i].second = row[j];
      }
    }
  }
  return best;
}

/// Squared distances between all descriptors, by |a|^2 + |b|^2 - 2 a.b.
cv::Mat distances(const cv::Mat& a, const cv::Mat& b) {
  cv::Mat product, a2, b2;
  cv::gemm(a, b, -2, cv::noArray(), 0, product, cv::GEMM_2_T);
  cv::reduce(a.mul(a), a2, 1, cv::REDUCE_SUM);
  cv::reduce(b.mul(b), b2, 1, cv::REDUCE_SUM);
  return product + cv::repeat(a2, 1, b.rows) + cv::repeat(b2.t(), a.rows, 1);
}

std::vector<Match> matched(const Features& a, const Features& b, double cosine) {
  if (a.pixels.empty() || b.pixels.empty()) return {};
  const cv::Mat between = distances(a.descriptors, b.descriptors);
  const auto of_a = nearest(between, a, b, cosine);
  const auto of_b = nearest(between.t(), b, a, cosine);
  std::vector<Match> matches;
  for (std::size_t i = 0; i < of_a.size(); ++i) {
    const Nearest& found = of_a[i];
    if (found.index < 0 || !(found.distance < kRatio * kRatio * found.second)) continue;
    const auto j = static_cast<std::size_t>(found.index);
    if (of_b[j].index == static_cast<int>(i)) matches.push_back({a.pixels[i], b.pixels[j]});
  }
  return matches;
}

}  // namespace

Features find_features(const std::vector<SphereFace>& faces, const optics::BallProjection& ball,
                       const std::optional<double>& closeness) {
  Features all;
  const cv::Ptr<cv::SIFT> sift = cv::SIFT::create(kMostPerFace, 3, kContrast);
  const cv::Mat element =
      cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * kEdge + 1, 2 * kEdge + 1});
  for (std::size_t index = 0; index < faces.size(); ++index) {
    const SphereFace& face = faces[index];
    cv::Mat mask, descriptors;
    cv::erode(face.shown, mask, element);
    if (cv::countNonZero(mask) == 0) continue;
    std::vector<cv::KeyPoint> points;
    sift->detectAndCompute(face.pixels, mask, points, descriptors);
    for (std::size_t n = 0; n < points.size(); ++n) {
      const auto direction = face.view.direction(points[n].pt.x, points[n].pt.y);
      if (!direction || face_of(*direction) != index) continue;
      const auto pixel = pixel_of(ball, *direction, closeness);
      if (!pixel) continue;
      all.pixels.push_back(*pixel);
      all.directions.push_back(*direction);
      all.descriptors.push_back(descriptors.row(static_cast<int>(n)));
    }
  }
  return all;
}

std::vector<Match> match_features(const Features& reference, const Features& camera) {
  return matched(reference, camera, -2);
}

std::vector<Match> match_features(const Features& reference, const Features& camera, double angle) {
  return matched(reference, camera, std::cos(angle));
}

}  // namespace orbwatch::align
