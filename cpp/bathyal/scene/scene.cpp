// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/scene/scene.hpp"

#include <utility>

#include "bathyal/base/error.hpp"
#include "bathyal/scene/hierarchy.hpp"

namespace bathyal {

Scene::Scene(std::vector<TriangleMesh> meshes, int num_threads) {
  if (meshes.empty()) throw_argument("meshes", "one mesh or more", "none");
  hierarchy_ = std::make_shared<const Hierarchy>(std::move(meshes), num_threads);
}

const std::vector<TriangleMesh>& Scene::meshes() const { return hierarchy_->meshes; }

std::size_t Scene::memory() const { return hierarchy_->memory(); }

const Scene::Hierarchy& Scene::hierarchy() const { return *hierarchy_; }

}  // namespace bathyal
