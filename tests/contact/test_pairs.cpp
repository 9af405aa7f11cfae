#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <map>
#include <set>

#include "pairs.h"

using namespace softreel;
using namespace softreel::sim;
using tests::NamedPair;

namespace {

using Vector12 = Eigen::Matrix<double, 12, 1>;
using Matrix12 = Eigen::Matrix<double, 12, 12>;

PairPenalty reaching(const NamedPair& pair) {
  PairPenalty p;
  p.stiffness = 3;
  p.offset = 0.01;
  p.reach = 1.7 * pair_distance(pair.kind, pair.x);
  if (pair.kind == PairKind::kEdgeEdge)
    p.cross_rest = (pair.x[1] - pair.x[0]).squaredNorm() * (pair.x[3] - pair.x[2]).squaredNorm();
  return p;
}

double value_at(const NamedPair& pair, const PairPenalty& p, const FourPoints& x) {
  const ClosestPoints c = closest_points(pair.kind, x);
  return p.intrusion(c.distance) > 0 ? pair_value(pair.kind, x, c, p) : 0;
}

Vector12 gradient_at(const NamedPair& pair, const PairPenalty& p, const FourPoints& x) {
  FourPoints g;
  pair_gradient(pair.kind, x, closest_points(pair.kind, x), p, g);
  Vector12 result;
  for (size_t i = 0; i < 4; ++i) result.segment<3>(3 * static_cast<Eigen::Index>(i)) = g[i];
  return result;
}

FourPoints moved(FourPoints x, int i, double by) {
  x[static_cast<size_t>(i / 3)](i % 3) += by;
  return x;
}

struct Errors {
  double gradient = 0, hessian = 0, negative = 0, clamped = 0;
};

/// Largest errors relative to the norms: against central differences, and of the clamped Hessian against the exact one
/// with its negative eigenvalues set to zero.
Errors errors_of(const NamedPair& pair, const PairPenalty& p, double step) {
  Errors e;
  const ClosestPoints c = closest_points(pair.kind, pair.x);
  const Vector12 g = gradient_at(pair, p, pair.x);
  Vector12 numeric;
  Matrix12 numeric_hessian, exact, clamped;
  for (int i = 0; i < 12; ++i) {
    const FourPoints plus = moved(pair.x, i, step), minus = moved(pair.x, i, -step);
    numeric(i) = (value_at(pair, p, plus) - value_at(pair, p, minus)) / (2 * step);
    numeric_hessian.col(i) = (gradient_at(pair, p, plus) - gradient_at(pair, p, minus)) / (2 * step);
  }
  pair_hessian(pair.kind, pair.x, c, p, Definiteness::kExact, exact);
  pair_hessian(pair.kind, pair.x, c, p, Definiteness::kClamped, clamped);
  e.gradient = (g - numeric).norm() / g.norm();
  e.hessian = (exact - numeric_hessian).norm() / exact.norm();
  const Eigen::SelfAdjointEigenSolver<Matrix12> eigen(exact);
  const Vector12 positive = eigen.eigenvalues().cwiseMax(0.0);
  const Matrix12 projected = eigen.eigenvectors() * positive.asDiagonal() * eigen.eigenvectors().transpose();
  e.clamped = (clamped - projected).norm() / exact.norm();
  e.negative = -Eigen::SelfAdjointEigenSolver<Matrix12>(clamped).eigenvalues()(0) / exact.norm();
  return e;
}

}  // namespace

TEST_CASE("derivatives of the penalty of a pair are those of central differences in every region of the distance") {
  std::set<std::string> regions;
  for (const NamedPair& pair : tests::pairs_of_every_region(20)) {
    regions.insert(pair.region);
    const Errors e = errors_of(pair, reaching(pair), 1e-6);
    INFO(pair.region);
    CHECK(e.gradient < 1e-6);
    CHECK(e.hessian < 1e-6);
    CHECK(e.negative < 1e-10);
    CHECK(e.clamped < 1e-9);
  }
  // 3 vertices, 3 edges and the face of a triangle; 4 pairs of ends, 4 of an end and an edge, and inside both.
  CHECK(regions.size() == 16);
}

TEST_CASE("the penalty of nearly parallel edges is smooth") {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> number(-1, 1);
  int faded = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const double tilt = 0.03 * number(random);
    NamedPair pair{"",
                   PairKind::kEdgeEdge,
                   {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0.01 * number(random), 0),
                    Eigen::Vector3d(0.3 * number(random), 0.1, -tilt / 2), Eigen::Vector3d(0.8, 0.1, tilt / 2)}};
    const PairPenalty p = reaching(pair);
    if (parallel_share(pair.kind, pair.x, p) < 1) ++faded;
    const Errors e = errors_of(pair, p, 1e-7);
    CHECK(e.gradient < 1e-5);
    CHECK(e.hessian < 1e-4);
    CHECK(e.negative < 1e-10);
  }
  CHECK(faded > 100);
  // Exactly parallel: nothing, and nothing that is not finite.
  const FourPoints x = {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 0.1, 0),
                        Eigen::Vector3d(1, 0.1, 0)};
  const NamedPair parallel{"", PairKind::kEdgeEdge, x};
  const PairPenalty p = reaching(parallel);
  CHECK(value_at(parallel, p, x) == 0);
  CHECK(gradient_at(parallel, p, x).norm() == 0);
  Matrix12 H;
  for (const Definiteness d : {Definiteness::kExact, Definiteness::kClamped}) {
    pair_hessian(PairKind::kEdgeEdge, x, closest_points(PairKind::kEdgeEdge, x), p, d, H);
    CHECK(H.allFinite());
  }
}

TEST_CASE("the force of a pair goes to zero with the contact distance, and never beyond k times its square") {
  const NamedPair pair = tests::pairs_of_every_region(1).front();
  const double d = pair_distance(pair.kind, pair.x);
  PairPenalty p{2, 0.5, 0, 0};
  p.reach = d;
  CHECK(gradient_at(pair, p, pair.x).norm() == 0);
  p.reach = 1.001 * d;
  CHECK(p.force(p.intrusion(d)) == doctest::Approx(2 * 1e-6 * d * d).scale(0).epsilon(1e-9));
  CHECK(p.force(p.intrusion(0)) == doctest::Approx(2 * p.reach * p.reach).scale(0));
}
