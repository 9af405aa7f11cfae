#include "app/body_figure.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "sim/membrane.h"
#include "sim/solid.h"

namespace softreel::app {

BodyFigure::BodyFigure(const assets::SoftBody& body, const SolidShape& shape, int first)
    : show_(body.data->show), first_(first), count_(static_cast<int>(shape.rest.vertices.size())), corners_(4) {
  if (show_ == assets::Quantity::kSpeed) return;
  if (show_ == assets::Quantity::kPressure) {
    surface_ = sim::boundary_triangles(shape.rest);
    return;
  }
  for (const sim::Tet& t : shape.rest.tets) add_element(shape.rest.vertices, {t[0], t[1], t[2], t[3]}, 1);
  if (show_ != assets::Quantity::kStress) return;
  sim::TetMesh apart;
  for (const sim::Tet& t : shape.rest.tets) {
    const int n = static_cast<int>(apart.vertices.size());
    for (int corner : t) apart.vertices.push_back(shape.rest.vertices[static_cast<size_t>(corner)]);
    apart.tets.push_back({n, n + 1, n + 2, n + 3});
  }
  apart_ = sim::make_solid(body.material.model, body.material.young, body.material.poisson, apart, 0);
}

BodyFigure::BodyFigure(const assets::Cloth& cloth, const ClothShape& shape, int first)
    : show_(cloth.data->show), first_(first), count_(static_cast<int>(shape.rest.vertices.size())), corners_(3) {
  if (show_ == assets::Quantity::kSpeed) return;
  if (show_ == assets::Quantity::kPressure) {
    surface_ = shape.rest.triangles;
    return;
  }
  const double thickness = cloth.material.thickness;
  for (const sim::Triangle& t : shape.rest.triangles)
    add_element(shape.rest.vertices, {t[0], t[1], t[2], -1}, thickness);
  if (show_ != assets::Quantity::kStress) return;
  sim::TriangleMesh apart;
  for (const sim::Triangle& t : shape.rest.triangles) {
    const int n = static_cast<int>(apart.vertices.size());
    for (int corner : t) apart.vertices.push_back(shape.rest.vertices[static_cast<size_t>(corner)]);
    apart.triangles.push_back({n, n + 1, n + 2});
  }
  apart_ = sim::make_membrane(cloth.material.model, cloth.material.young, cloth.material.poisson, thickness, apart, 0);
}

void BodyFigure::add_element(const std::vector<sim::Vec3>& rest, std::array<int, 4> vertices, double thickness) {
  Element element{vertices, Eigen::Matrix3d::Identity(), 0};
  for (int k = 1; k < corners_; ++k)
    element.rest.col(k - 1) =
        rest[static_cast<size_t>(vertices[static_cast<size_t>(k)])] - rest[static_cast<size_t>(vertices[0])];
  if (corners_ == 3) {
    const Eigen::Vector3d normal = element.rest.col(0).cross(element.rest.col(1));
    element.size = 0.5 * normal.norm() * thickness;
    element.rest.col(2) = normal.normalized();
  } else {
    element.size = element.rest.determinant() / 6;
  }
  elements_.push_back(element);
}

Eigen::Matrix3d BodyFigure::edges(const sim::State& state, const Element& element) const {
  const auto at = [&](int vertex) -> Eigen::Vector3d { return state.x.segment<3>(3 * (first_ + vertex)); };
  Eigen::Matrix3d d = Eigen::Matrix3d::Identity();
  for (int k = 1; k < corners_; ++k)
    d.col(k - 1) = at(element.vertices[static_cast<size_t>(k)]) - at(element.vertices[0]);
  if (corners_ == 3) d.col(2) = d.col(0).cross(d.col(1)).normalized();
  return d;
}

Eigen::VectorXd BodyFigure::pressure(const CachedFrame& frame) const {
  Eigen::VectorXd area = Eigen::VectorXd::Zero(count_);
  const auto at = [&](int vertex) -> Eigen::Vector3d { return frame.state.x.segment<3>(3 * (first_ + vertex)); };
  for (const sim::Triangle& t : surface_) {
    const double third = (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0])).norm() / 6;
    for (const int vertex : t) area(vertex) += third;
  }
  Eigen::VectorXd values = Eigen::VectorXd::Zero(count_);
  for (int i = 0; i < count_; ++i)
    if (area(i) > 0) values(i) = frame.contact_force.segment<3>(3 * (first_ + i)).norm() / area(i);
  return values;
}

Eigen::VectorXd BodyFigure::values(const CachedFrame& frame) const {
  if (show_ == assets::Quantity::kPressure) return pressure(frame);
  const sim::State& state = frame.state;
  Eigen::VectorXd values = Eigen::VectorXd::Zero(count_);
  if (show_ == assets::Quantity::kSpeed) {
    for (int i = 0; i < count_; ++i) values(i) = state.v.segment<3>(3 * (first_ + i)).norm();
    return values;
  }
  Eigen::VectorXd forces;
  const auto n = static_cast<Eigen::Index>(corners_);
  if (apart_) {
    Eigen::VectorXd x(3 * n * static_cast<Eigen::Index>(elements_.size()));
    for (size_t e = 0; e < elements_.size(); ++e)
      for (Eigen::Index k = 0; k < n; ++k)
        x.segment<3>(3 * (static_cast<Eigen::Index>(e) * n + k)) =
            state.x.segment<3>(3 * (first_ + elements_[e].vertices[static_cast<size_t>(k)]));
    forces = Eigen::VectorXd::Zero(x.size());
    apart_->add_gradient(x, forces);
  }
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(count_);
  for (size_t e = 0; e < elements_.size(); ++e) {
    const Element& element = elements_[e];
    const Eigen::Matrix3d deformation = edges(state, element) * element.rest.inverse();
    double value = 0;
    if (show_ == assets::Quantity::kStrain) {
      // In the plane of a cloth; its normal is carried along with length 1 and must not count.
      Eigen::Matrix3d f = deformation;
      if (corners_ == 3) f -= f * element.rest.col(2) * element.rest.col(2).transpose();
      value = f.jacobiSvd().singularValues()(0) - 1;
    } else {
      // The gradient at corners 1, 2, ... is size P Dm^-T, so P = G Dm^T / size; Cauchy's stress is P F^T / J.
      Eigen::Matrix3d g = Eigen::Matrix3d::Zero();
      for (Eigen::Index k = 1; k < n; ++k) g.col(k - 1) = forces.segment<3>(3 * (static_cast<Eigen::Index>(e) * n + k));
      const Eigen::Matrix3d piola = g * element.rest.transpose() / element.size;
      const double j = std::max(std::abs(deformation.determinant()), 1e-12);
      const Eigen::Matrix3d cauchy = piola * deformation.transpose() / j;
      const Eigen::Matrix3d deviator = cauchy - cauchy.trace() / 3 * Eigen::Matrix3d::Identity();
      value = std::sqrt(1.5) * deviator.norm();
    }
    for (Eigen::Index k = 0; k < n; ++k) {
      const int vertex = element.vertices[static_cast<size_t>(k)];
      values(vertex) += element.size * value;
      weights(vertex) += element.size;
    }
  }
  for (int i = 0; i < count_; ++i)
    if (weights(i) > 0) values(i) /= weights(i);
  return values;
}

std::string figure_label(assets::Quantity show) {
  switch (show) {
    case assets::Quantity::kSpeed:
      return "Speed [m/s]";
    case assets::Quantity::kStrain:
      return "Strain [-]";
    case assets::Quantity::kPressure:
      return "Contact pressure [Pa]";
    case assets::Quantity::kStress:
      break;
  }
  return "von Mises stress [Pa]";
}

}  // namespace softreel::app
