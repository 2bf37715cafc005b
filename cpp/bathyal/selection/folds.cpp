// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/selection/folds.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "bathyal/selection/decisions.hpp"

namespace bathyal::selection {
namespace {

/// Of each fold, where only the order of a list is known: a list is often a sweep, and one block of
/// it covers a region that no other row is near.
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

std::vector<int> find_replicates(const Eigen::Ref<const Eigen::MatrixXd>& q, double near) {
  const Index n = q.rows();
  Unions unions(static_cast<std::size_t>(n));
  // Sorted along the column of largest range: replicates are close together there.
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

/// With `by_group`, whole groups share a fold too.
Folds cut(const Observations& observations, int wanted, bool by_group) {
  const auto n = static_cast<std::size_t>(observations.count());
  Folds out;
  out.fold_of.assign(n, 0);
  std::vector<int> key = observations.replicate;
  if (by_group) {
    // Folds must not share an unknown of the model.
    Unions unions(n);
    std::map<int, int> first_of_group, first_replicate;
    for (int i = 0; i < static_cast<int>(n); ++i) {
      if (observations.group[i] >= 0)
        unions.join(i, first_of_group.emplace(observations.group[i], i).first->second);
      unions.join(i, first_replicate.emplace(observations.replicate[i], i).first->second);
    }
    for (int i = 0; i < static_cast<int>(n); ++i) key[i] = unions.root(i);
    out.description = "whole touched points were held out";
  }
  // Keys in the order of their first observation, session by session; groups that occur in several
  // sessions belong to none.
  const auto session_of = [&](int i) { return by_group ? 0 : observations.session[i]; };
  std::vector<int> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return std::pair(session_of(a), observations.order[a]) <
           std::pair(session_of(b), observations.order[b]);
  });
  // A key that occurs in several sessions counts in its first one.
  std::map<int, std::size_t> size_in_session, before;
  std::map<int, std::size_t> size_of_key;
  std::map<int, int> session_of_key;
  for (const int i : order) {
    ++size_in_session[session_of_key.emplace(key[i], session_of(i)).first->second];
    ++size_of_key[key[i]];
  }
  const auto folds = std::min(static_cast<std::size_t>(wanted), n);
  std::map<int, int> block_of_key;
  std::size_t dealt = 0;
  for (const int i : order) {
    if (block_of_key.contains(key[i])) continue;
    std::size_t& place = before[session_of(i)];
    const std::size_t size = size_in_session[session_of(i)];
    // A session of fewer observations than folds misses the last ones: the next session goes on
    // there.
    const std::size_t pieces =
        observations.timed ? 1 : std::clamp(size / folds, std::size_t{1}, kPieces);
    const std::size_t fold =
        size < folds ? dealt++ % folds
                     : std::min(place * folds * pieces / size, folds * pieces - 1) % folds;
    block_of_key[key[i]] = static_cast<int>(fold);
    place += size_of_key[key[i]];
  }
  std::vector<int> raw(n);
  for (std::size_t i = 0; i < n; ++i) raw[i] = block_of_key[key[i]];
  out.fold_of = counted_up(raw);
  out.count = count_of(out.fold_of);
  if (out.description.empty()) {
    out.description =
        std::to_string(out.count) +
        (observations.timed ? " blocks of poses that follow one another"
                            : " blocks of short runs of poses") +
        " were held out in turn" +
        (count_of(observations.session) > 1 ? ", each with its share of every session" : "");
  }
  return out;
}

}  // namespace

Folds make_folds(const Observations& observations, int wanted) {
  const int points = observations.group.empty() ? 0 : count_of(observations.group);
  if (points >= Decisions::kMinGroups) {
    // Touches of planes, or replicates that join groups, may leave too few folds.
    Folds whole = cut(observations, wanted, true);
    if (2 * whole.count >= Decisions::kMinGroups) return whole;
  }
  return cut(observations, wanted, false);
}

Folds folds_of_groups(const std::vector<int>& group_of) {
  const int groups = count_of(group_of);
  Folds out;
  out.count = std::min(groups, kMostGroupFolds);
  for (const int group : group_of) out.fold_of.push_back(group % kMostGroupFolds);
  out.description = groups == out.count
                        ? std::to_string(groups) + " given groups were held out in turn"
                        : std::to_string(groups) + " given groups were held out in " +
                              std::to_string(out.count) + " sets of whole groups";
  return out;
}

}  // namespace bathyal::selection
