#pragma once

#include <array>
#include <span>
#include <vector>

#include "proc/remap/merge.h"
#include "proc/remap/transfer_function.h"

namespace orbwatch::remap {

/// What brings a source's samples to the first source's exposure, white balance and black level:
/// per channel, in light, matched = gain * light + offset.
struct PhotometricMatch {
  struct Channel {
    double gain = 1;
    double offset = 0;  ///< share of full scale
  };
  enum class Outcome {
    Reference,    ///< others are matched to it: the first source
    Matched,      ///< by what it sees together with the others
    TooLittle,    ///< sees too little together with them, or nothing that agrees: left as it is
    Implausible,  ///< gain beyond 1/16..16 or offset beyond 25 % of full scale: left as it is
  };
  std::array<Channel, 3> channels;
  Outcome outcome = Outcome::Reference;
};

/// Compares pictures of one view wherever two of them see the same and finds what makes them agree:
/// a robust line per pair and channel (fit_line) through the means of blocks of 8x8 pixels, so that
/// a sharper camera's finer detail does not count; then all sources together by least squares.
/// Blocks count by the lesser of the two weights: what is blended is matched. Blocks with nearly
/// black or saturated samples are left out. One match per source, in their order. Reentrant.
template <class T>
std::vector<PhotometricMatch> match_photometry(std::span<const MergeSource<T>> sources,
                                               Transfer transfer);

/// Applies a match to a picture, by table.
template <class T>
void apply(const PhotometricMatch& match, Transfer transfer, const ImageView<T>& picture);

}  // namespace orbwatch::remap
