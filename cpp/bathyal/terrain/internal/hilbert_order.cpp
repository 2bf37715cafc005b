// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/terrain/internal/hilbert_order.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "bathyal/base/parallel.hpp"

namespace bathyal::terrain {
namespace {

constexpr std::size_t kKeyGrain = 1 << 16;
constexpr std::size_t kFew = 8;  // up to so many points in a cell are simply sorted
constexpr std::size_t kRadixSort =
    4096;  // from so many points on the radix sort is worth its tables

/// A point on its way through the sort: its place on the curve above, its row below.
using Item = std::uint64_t;

std::uint32_t key_of(Item item) { return static_cast<std::uint32_t>(item >> 32U); }
std::int32_t row_of(Item item) { return static_cast<std::int32_t>(item & 0xffffffffU); }

/// Three levels of the Hilbert curve at once: [orientation][x · 8 + y] holds six bits of the place
/// along the curve and, above them, the orientation to go on with.
constexpr auto kCurve = [] {
  std::array<std::array<std::uint8_t, 64>, 4> table{};
  for (unsigned start = 0; start < 4; ++start) {
    for (unsigned cell = 0; cell < 64; ++cell) {
      unsigned orientation = start, place = 0;  // bit 0: axes swapped, bit 1: both turned round
      for (unsigned level = 3; level-- > 0;) {
        const unsigned turned = orientation >> 1U;
        unsigned x = ((cell >> (3 + level)) & 1U) ^ turned;
        unsigned y = ((cell >> level) & 1U) ^ turned;
        if ((orientation & 1U) != 0) std::swap(x, y);
        place = place * 4 + ((3 * x) ^ y);
        if (y == 0) orientation ^= x == 1 ? 3U : 1U;
      }
      table[start][cell] = static_cast<std::uint8_t>(orientation << 6U | place);
    }
  }
  return table;
}();

struct Extent {
  double x_low = std::numeric_limits<double>::infinity(), x_high = -x_low;
  double y_low = x_low, y_high = -x_low;

  void add(double x, double y) {
    x_low = std::min(x_low, x);
    x_high = std::max(x_high, x);
    y_low = std::min(y_low, y);
    y_high = std::max(y_high, y);
  }
  double extent() const { return std::max(x_high - x_low, y_high - y_low); }
};

/// Square cells over a box, 8^triples on its longer side.
class Curve {
 public:
  Curve(const Extent& box, std::size_t count) : box_(box) {
    while (triples_ < 5 && std::size_t{1} << (6 * triples_) < 2 * count) ++triples_;
    cells_ = static_cast<double>(1U << (3 * triples_));
  }

  unsigned key_bits() const { return 6 * triples_; }

  std::uint32_t place(double x, double y) const {
    const std::uint32_t column = cell(x - box_.x_low), row = cell(y - box_.y_low);
    std::uint32_t place = 0, orientation = 0;
    for (unsigned shift = 3 * triples_; shift > 0;) {
      shift -= 3;
      const unsigned index = ((column >> shift) & 7U) * 8 + ((row >> shift) & 7U);
      const unsigned step = kCurve[orientation][index];
      place = place << 6U | (step & 63U);
      orientation = step >> 6U;
    }
    return place;
  }

 private:
  std::uint32_t cell(double offset) const {
    return static_cast<std::uint32_t>(std::min(offset / box_.extent() * cells_, cells_ - 1.0));
  }

  Extent box_;
  unsigned triples_ = 1;
  double cells_ = 8.0;
};

Extent bounding_box(PointView points, std::span<const Item> items) {
  Extent box;
  for (const Item item : items) box.add(points(row_of(item), 0), points(row_of(item), 1));
  return box;
}

/// Stable radix sort by bits [shift, shift + bits) of the key; chunks are counted and scattered
/// side by side and give the same order however many there are.
void radix_pass(std::span<const Item> from, std::span<Item> to, unsigned shift, unsigned bits,
                int num_threads) {
  const std::size_t buckets = std::size_t{1} << bits;
  const std::size_t grain =
      from.size() / static_cast<std::size_t>(resolve_threads(num_threads)) + 1;
  const std::size_t chunks = (from.size() + grain - 1) / grain;
  const auto bucket = [&](Item item) { return (item >> (32 + shift)) & (buckets - 1); };
  std::vector<std::uint32_t> place(chunks * buckets, 0);
  parallel_for(from.size(), grain, num_threads, [&](std::size_t begin, std::size_t end) {
    std::uint32_t* count = &place[begin / grain * buckets];
    for (std::size_t i = begin; i < end; ++i) ++count[bucket(from[i])];
  });
  std::uint32_t total = 0;
  for (std::size_t b = 0; b < buckets; ++b) {
    for (std::size_t c = 0; c < chunks; ++c) {
      const std::uint32_t count = std::exchange(place[c * buckets + b], total);
      total += count;
    }
  }
  parallel_for(from.size(), grain, num_threads, [&](std::size_t begin, std::size_t end) {
    std::uint32_t* next = &place[begin / grain * buckets];
    for (std::size_t i = begin; i < end; ++i) to[next[bucket(from[i])]++] = from[i];
  });
}

void sort_by_key(PageVector<Item>& items, unsigned key_bits, int num_threads) {
  const unsigned passes = (key_bits + 11) / 12;
  const unsigned bits = key_bits / passes;
  PageVector<Item> other(items.size());
  for (unsigned pass = 0; pass < passes; ++pass) {
    radix_pass(items, other, pass * bits, bits, num_threads);
    items.swap(other);
  }
}

void sort_cells(PointView points, std::span<Item> items);

/// Few points, or points all in one place: by x, y, z, row.
void sort_directly(PointView points, std::span<Item> items) {
  std::sort(items.begin(), items.end(), [&](Item a, Item b) {
    const auto p = points.row(row_of(a)), q = points.row(row_of(b));
    return std::make_tuple(p(0), p(1), p(2), row_of(a)) <
           std::make_tuple(q(0), q(1), q(2), row_of(b));
  });
}

/// A crowded cell, which holds clusters: a curve of its own over what it holds.
void sort_crowd(PointView points, std::span<Item> items) {
  const Extent box = bounding_box(points, items);
  if (items.size() <= kFew || !(box.extent() > 0.0)) return sort_directly(points, items);
  const Curve curve(box, items.size());
  for (Item& item : items) {
    const auto row = static_cast<Item>(row_of(item));
    item = Item{curve.place(points(row_of(item), 0), points(row_of(item), 1))} << 32U | row;
  }
  std::sort(items.begin(), items.end());
  sort_cells(points, items);
}

/// Settles the order within each run of equal keys.
void sort_cells(PointView points, std::span<Item> items) {
  for (std::size_t begin = 0; begin < items.size();) {
    std::size_t end = begin + 1;
    while (end < items.size() && key_of(items[end]) == key_of(items[begin])) ++end;
    if (end - begin > 1) sort_crowd(points, items.subspan(begin, end - begin));
    begin = end;
  }
}

/// Cuts `items` into about equal parts, none in the middle of a run of equal keys.
std::vector<std::size_t> cut_between_cells(std::span<const Item> items) {
  std::vector<std::size_t> cuts{0};
  while (cuts.back() < items.size()) {
    std::size_t cut = std::min(cuts.back() + kKeyGrain, items.size());
    while (cut < items.size() && key_of(items[cut]) == key_of(items[cut - 1])) ++cut;
    cuts.push_back(cut);
  }
  return cuts;
}

Extent bounding_box(PointView points, int num_threads) {
  const auto count = static_cast<std::size_t>(points.rows());
  std::vector<Extent> boxes((count + kKeyGrain - 1) / kKeyGrain);
  parallel_for(count, kKeyGrain, num_threads, [&](std::size_t begin, std::size_t end) {
    Extent& box = boxes[begin / kKeyGrain];
    for (auto i = static_cast<Index>(begin); i < static_cast<Index>(end); ++i) {
      box.add(points(i, 0), points(i, 1));
    }
  });
  Extent box;
  for (const Extent& part : boxes) {
    box.add(part.x_low, part.y_low);
    box.add(part.x_high, part.y_high);
  }
  return box;
}

PageVector<Item> sorted_items(PointView points, int num_threads) {
  const auto count = static_cast<std::size_t>(points.rows());
  const Extent box = bounding_box(points, num_threads);
  const Curve curve(box, count);
  const bool one_place = !(box.extent() > 0.0);
  PageVector<Item> items(count);
  parallel_for(count, kKeyGrain, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto row = static_cast<Index>(i);
      const Item place = one_place ? 0 : curve.place(points(row, 0), points(row, 1));
      items[i] = place << 32U | i;
    }
  });
  if (count < kRadixSort) {
    std::sort(items.begin(), items.end());
  } else {
    sort_by_key(items, curve.key_bits(), num_threads);
  }
  const std::vector<std::size_t> cuts = cut_between_cells(items);
  parallel_for(cuts.size() - 1, 1, num_threads, [&](std::size_t part, std::size_t) {
    sort_cells(points, std::span(items).subspan(cuts[part], cuts[part + 1] - cuts[part]));
  });
  return items;
}

}  // namespace

PageVector<std::int32_t> hilbert_order(PointView points, int num_threads) {
  const PageVector<Item> items = sorted_items(points, num_threads);
  PageVector<std::int32_t> rows(items.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const std::int32_t row = row_of(items[i]);
    const bool repeated = i > 0 && key_of(items[i]) == key_of(items[i - 1]) &&
                          points(row, 0) == points(rows[count - 1], 0) &&
                          points(row, 1) == points(rows[count - 1], 1);
    rows[count] = row;
    if (!repeated) ++count;
  }
  rows.resize(count);
  return rows;
}

}  // namespace bathyal::terrain
