// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <utility>

namespace bathyal {

using Eigen::Index;
using Vec3 = Eigen::Vector3d;

/// A (rows, Cols) row-major array whose memory is shared, not copied: a cloud, the mesh made from
/// it and the numpy arrays that show them all point at the same numbers. The owner may be a matrix
/// of ours or anything else that keeps the memory alive (a numpy array). Nothing here writes to it;
/// a caller may still write to an array that it gave (`writable`). So an algorithm that counts,
/// sorts or indexes by the values, or relies on a check of them, works on a `snapshot()`: checked
/// and read are then the same numbers. What is kept and only shown to the caller again stays
/// shared.
template <class Scalar, int Cols>
class SharedArray {
 public:
  static constexpr int kOrder = Cols == 1 ? Eigen::ColMajor : Eigen::RowMajor;
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Cols, kOrder>;
  using View = Eigen::Map<const Matrix>;

  SharedArray() = default;

  /// Takes the matrix over; no copy when it is moved in.
  SharedArray(Matrix matrix)  // NOLINT(google-explicit-constructor): a matrix is such an array
      : rows_(matrix.rows()) {
    auto owned = std::make_shared<const Matrix>(std::move(matrix));
    data_ = owned->data();
    owner_ = std::move(owned);
  }

  /// Shares `rows` rows at `data`, which `owner` keeps alive. `writable`: somebody else may still
  /// write to them.
  SharedArray(const Scalar* data, Index rows, std::shared_ptr<const void> owner,
              bool writable = false)
      : data_(data), rows_(rows), owner_(std::move(owner)), writable_(writable) {}

  /// The numbers as they are now, which nobody can write to: this array itself, or where somebody
  /// may write to it a copy.
  SharedArray snapshot() const { return writable_ ? SharedArray(Matrix(view())) : *this; }

  View view() const { return View(data_, rows_, Cols); }
  const Scalar* data() const { return data_; }
  Index rows() const { return rows_; }
  bool empty() const { return rows_ == 0; }
  bool writable() const { return writable_; }
  const std::shared_ptr<const void>& owner() const { return owner_; }

 private:
  const Scalar* data_ = nullptr;
  Index rows_ = 0;
  std::shared_ptr<const void> owner_;
  bool writable_ = false;
};

using Points = SharedArray<double, 3>;           ///< (N, 3) positions or vectors
using PointMatrix = Points::Matrix;              ///< the same, owned and writable
using PointView = Points::View;                  ///< the same, read in place
using Triangles = SharedArray<std::int32_t, 3>;  ///< (T, 3) vertex indices
using TriangleMatrix = Triangles::Matrix;
using TriangleView = Triangles::View;
using Values = SharedArray<double, 1>;         ///< (N,) one number a point
using Indices = SharedArray<std::int32_t, 1>;  ///< (N,) indices, -1 where there is none

}  // namespace bathyal
