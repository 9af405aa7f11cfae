#include "sim/preconditioner.h"

#include <array>

#include "sim/diagonal_preconditioner.h"
#include "sim/incomplete_cholesky.h"
#include "sim/method_table.h"
#include "sim/multigrid_preconditioner.h"

namespace softreel::sim {
namespace {

struct Entry {
  MethodInfo info;
  std::unique_ptr<Preconditioner> (*make)();
};

template <class P>
constexpr Entry entry(const MethodInfo& info) {
  return {info, []() -> std::unique_ptr<Preconditioner> { return std::make_unique<P>(); }};
}

// The one table of preconditioners. Costs of one application, in products with A.
constexpr std::array kPreconditioners = {
    entry<NoPreconditioner>({"none", "P = I: the plain method", "nothing", ""}),
    entry<JacobiPreconditioner>({"jacobi", "the diagonal", "O(n), a tenth of a product", "Saad 2003, section 10.2"}),
    entry<BlockJacobiPreconditioner>(
        {"block-jacobi", "the 3x3 blocks of the vertices", "O(n), a tenth of a product", "Saad 2003, section 12.2"}),
    entry<IncompleteCholesky>({"incomplete-cholesky", "L L^T on the pattern of A, in 3x3 blocks, shifted if need be",
                               "O(n), one product, sequential",
                               "Meijerink, van der Vorst 1977; shift: Manteuffel 1980; Lin, More 1999"}),
    entry<MultigridPreconditioner>({"multigrid", "one V-cycle of smoothed aggregation of the rigid-body modes",
                                    "O(n), three products, mostly sequential", "Vanek, Mandel, Brezina 1996"}),
};

}  // namespace

Catalogue preconditioners() { return catalogue_of<kPreconditioners>(); }

std::unique_ptr<Preconditioner> make_preconditioner(std::string_view name) {
  return find_method(kPreconditioners, name, "preconditioner").make();
}

}  // namespace softreel::sim
