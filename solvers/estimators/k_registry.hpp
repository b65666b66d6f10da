#pragma once

#include <tuple>

#include "solvers/estimators/k_expr.hpp"
#include "solvers/estimators/k_fixed.hpp"
#include "solvers/estimators/k_gcv.hpp"
#include "solvers/estimators/k_hk.hpp"
#include "solvers/estimators/k_hk_max.hpp"
#include "solvers/estimators/k_hkb.hpp"
#include "solvers/estimators/k_khalaf_shukur.hpp"
#include "solvers/estimators/k_kibria_am.hpp"
#include "solvers/estimators/k_kibria_gm.hpp"
#include "solvers/estimators/k_kibria_med.hpp"
#include "solvers/estimators/k_lawless_wang.hpp"
#include "solvers/estimators/k_muniz_kibria.hpp"
#include "solvers/estimators/k_oracle.hpp"
#include "solvers/estimators/k_thisted.hpp"

namespace ridgeloc::solvers {

/// The estimators of the ridge parameter. A new one is a file with its class and a line here.
using KEstimators = std::tuple<KibriaGm,                    //
                               KibriaAm,                    //
                               KibriaMed,                   //
                               HoerlKennard,                //
                               HoerlKennardMax,             //
                               HoerlKennardBaldwin,         //
                               Thisted,                     //
                               LawlessWang,                 //
                               KhalafShukur,                //
                               Mk2, Mk3, Mk4, Mk5, Mk6,     //
                               GeneralizedCrossValidation,  //
                               FixedK, OracleElem, OracleGm, KByFormula>;

}  // namespace ridgeloc::solvers
