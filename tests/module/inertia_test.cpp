// What a fragment weighs and how it turns, against sums in double over its own triangles, and against the model's.
#include "tests/module/whole_fracture.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

struct Weighed {
    double volume = 0;
    Vector3d moment = Vector3d::Zero();
    Matrix3d second = Matrix3d::Zero(); // about the origin
    void add(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
        const double v = a.dot(b.cross(c)) / 6;
        const Vector3d s = a + b + c;
        volume += v;
        moment += v / 4 * s;
        second += v / 20 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + s * s.transpose());
    }
    Vector3d center() const { return moment / volume; }
    Matrix3d inertia() const {
        const Matrix3d about = second - volume * center() * center().transpose();
        return about.trace() * Matrix3d::Identity() - about;
    }
};

Vector3d placeOf(const brittle::FragmentVertex& v) { return {v.position[0], v.position[1], v.position[2]}; }

Weighed weigh(const brittle::FragmentSet& set, const brittle::Fragment& fragment) {
    Weighed sum;
    for (uint32_t k = 0; k < fragment.outer_index_count + fragment.inner_index_count; k += 3) {
        const auto corner = [&](uint32_t i) {
            return placeOf(set.vertices[fragment.first_vertex + set.indices[fragment.first_index + k + i]]);
        };
        sum.add(corner(0), corner(1), corner(2));
    }
    return sum;
}

Matrix3d tensorOf(const brittle::Fragment& f) {
    const auto& i = f.inertia;
    return Matrix3d{{i[0], i[3], i[4]}, {i[3], i[1], i[5]}, {i[4], i[5], i[2]}};
}

Vector3d centroidOf(const brittle::Fragment& f) { return {f.centroid[0], f.centroid[1], f.centroid[2]}; }

void expectWeighed(const brittle::PreparedMesh& model, const brittle::FragmentSet& set) {
    Weighed all;
    for (const brittle::Index3& t : model.mesh.triangles) {
        std::array<Vector3d, 3> p;
        for (size_t k = 0; k < 3; ++k)
            p[k] = Eigen::Map<const Eigen::Vector3f>(model.mesh.positions[t[k]].data()).cast<double>();
        all.add(p[0], p[1], p[2]);
    }
    Matrix3d sum = Matrix3d::Zero();
    Vector3d moment = Vector3d::Zero();
    for (const brittle::Fragment& f : set.fragments) {
        const Weighed own = weigh(set, f);
        EXPECT_NEAR(f.volume, own.volume, 1e-6 * own.volume + 1e-12 * all.volume);
        EXPECT_LT((tensorOf(f) - own.inertia()).norm(), 2e-5 * own.inertia().norm() + 1e-12 * all.inertia().norm());
        const Vector3d d = centroidOf(f) - all.center();
        sum += tensorOf(f) + f.volume * (d.squaredNorm() * Matrix3d::Identity() - d * d.transpose());
        moment += f.volume * centroidOf(f);
    }
    EXPECT_LT((sum - all.inertia()).norm(), 1e-6 * all.inertia().norm());
    EXPECT_LT((moment / all.volume - all.center()).norm(), 1e-6);
}

TEST(Inertia, OfFragmentsAddsUpToTheModels) {
    for (const auto& [name, sites] :
         {std::pair{"cube", 1u}, {"cube", 50u}, {"ring", 200u}, {"bumpy:4", 1000u}, {"icosphere:3", 7u}}) {
        SCOPED_TRACE(name);
        const brittle::PreparedMesh prepared = whole::modelFrom(std::string("builtin:") + name).prepared;
        brittle::FractureOptions options;
        options.site_count = sites;
        const auto result = whole::fracture().shatter(prepared.mesh, prepared.topology, options);
        ASSERT_TRUE(result) << result.error().message;
        expectWeighed(prepared, result->fragments);
    }
}

} // namespace
