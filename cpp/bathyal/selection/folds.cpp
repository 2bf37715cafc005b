// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/selection/folds.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace bathyal {
namespace {

/// Fewer points than this, and to hold one out would hold out too much.
constexpr int kLeastPoints = 6;
/// Of each block, where only the order of a list is known: a list is often a sweep, one block of
/// which would hold out a region that no other row comes near.
constexpr std::size_t kPieces = 8;

class Unions {
 public:
  explicit Unions(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  int root(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(int a, int b) {
    const int first = root(a), second = root(b);
    parent_[std::max(first, second)] = std::min(first, second);
  }

 private:
  std::vector<int> parent_;
};

/// Numbers 0, 1, … in the order in which values first appear.
std::vector<int> counted_up(const std::vector<int>& values) {
  std::map<int, int> known;
  std::vector<int> out;
  for (const int value : values) {
    out.push_back(known.emplace(value, static_cast<int>(known.size())).first->second);
  }
  return out;
}

int count_of(const std::vector<int>& numbers) {
  return numbers.empty() ? 0 : 1 + *std::max_element(numbers.begin(), numbers.end());
}

}  // namespace

std::vector<int> find_twins(const Eigen::Ref<const Eigen::MatrixXd>& q, double near) {
  const Index n = q.rows();
  Unions unions(static_cast<std::size_t>(n));
  // Sorted along the column that spreads most: twins lie close together there.
  Eigen::VectorXd spread(q.cols());
  for (Index c = 0; c < q.cols(); ++c) spread[c] = q.col(c).maxCoeff() - q.col(c).minCoeff();
  Index widest = 0;
  if (q.cols() > 0) spread.maxCoeff(&widest);
  std::vector<int> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return q(a, widest) < q(b, widest); });
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      if (q(order[j], widest) - q(order[i], widest) > near) break;
      if ((q.row(order[i]) - q.row(order[j])).cwiseAbs().maxCoeff() <= near) {
        unions.join(order[i], order[j]);
      }
    }
  }
  std::vector<int> out;
  for (int i = 0; i < static_cast<int>(n); ++i) out.push_back(unions.root(i));
  return counted_up(out);
}

namespace {

/// With `by_point`, whole points are in one block too.
Blocks cut(const Units& units, int wanted, bool by_point) {
  const auto n = static_cast<std::size_t>(units.count());
  Blocks out;
  out.of.assign(n, 0);
  std::vector<int> key = units.twin;
  if (by_point) {
    // What is held out together must not share a point that the model leaves free.
    Unions unions(n);
    std::map<int, int> first_of_point, first_twin;
    for (int i = 0; i < static_cast<int>(n); ++i) {
      if (units.point[i] >= 0)
        unions.join(i, first_of_point.emplace(units.point[i], i).first->second);
      unions.join(i, first_twin.emplace(units.twin[i], i).first->second);
    }
    for (int i = 0; i < static_cast<int>(n); ++i) key[i] = unions.root(i);
    out.how = "whole touched points were held out";
  }
  // Groups in the order of their first unit, session by session; points that are touched in several
  // sessions are of none.
  const auto session_of = [&](int i) { return by_point ? 0 : units.session[i]; };
  std::vector<int> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return std::pair(session_of(a), units.order[a]) < std::pair(session_of(b), units.order[b]);
  });
  // What repeats in several sessions counts in that where it came first.
  std::map<int, std::size_t> size_in_session, before;
  std::map<int, std::size_t> size_of_key;
  std::map<int, int> session_of_key;
  for (const int i : order) {
    ++size_in_session[session_of_key.emplace(key[i], session_of(i)).first->second];
    ++size_of_key[key[i]];
  }
  const auto blocks = std::min(static_cast<std::size_t>(wanted), n);
  std::map<int, int> block_of_key;
  std::size_t dealt = 0;
  for (const int i : order) {
    if (block_of_key.contains(key[i])) continue;
    std::size_t& place = before[session_of(i)];
    const std::size_t size = size_in_session[session_of(i)];
    // A session of fewer units than blocks has none for some: the next one goes on there.
    const std::size_t pieces = units.timed ? 1 : std::clamp(size / blocks, std::size_t{1}, kPieces);
    const std::size_t block =
        size < blocks ? dealt++ % blocks
                      : std::min(place * blocks * pieces / size, blocks * pieces - 1) % blocks;
    block_of_key[key[i]] = static_cast<int>(block);
    place += size_of_key[key[i]];
  }
  std::vector<int> raw(n);
  for (std::size_t i = 0; i < n; ++i) raw[i] = block_of_key[key[i]];
  out.of = counted_up(raw);
  out.count = count_of(out.of);
  if (out.how.empty()) {
    out.how = std::to_string(out.count) +
              (units.timed ? " blocks of poses that follow one another"
                           : " blocks of short runs of poses") +
              " were held out in turn" +
              (count_of(units.session) > 1 ? ", each with its share of every session" : "");
  }
  return out;
}

}  // namespace

Blocks make_blocks(const Units& units, int wanted) {
  const int points = units.point.empty() ? 0 : count_of(units.point);
  if (points >= kLeastPoints) {
    // Touches of planes, or twins that join points, may leave too few to hold out.
    Blocks whole = cut(units, wanted, true);
    if (2 * whole.count >= kLeastPoints) return whole;
  }
  return cut(units, wanted, false);
}

}  // namespace bathyal
