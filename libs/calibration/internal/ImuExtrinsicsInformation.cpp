#include "calibration/internal/ImuExtrinsicsInformation.h"

#include <Eigen/SparseCholesky>

namespace scanloom
{
namespace
{
using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;
using Sparse = Eigen::SparseMatrix<double>;
}  // namespace

ExtrinsicsInformation informationOfLast7(const ceres::CRSMatrix& crs, const std::vector<double>& residuals,
                                         const std::vector<std::size_t>& pose_of_row, std::size_t poses)
{
  const SparseRows all = Eigen::Map<const SparseRows>(crs.num_rows, crs.num_cols, crs.values.size(), crs.rows.data(),
                                                      crs.cols.data(), crs.values.data());
  const Eigen::Index others = crs.num_cols - 7;
  const Sparse columns = all;
  const Sparse nuisance = columns.leftCols(others);
  const Eigen::MatrixXd extrinsics = Eigen::MatrixXd(columns.rightCols(7)) * extrinsicsStepOfMetres().asDiagonal();
  const Sparse normal = nuisance.transpose() * nuisance;
  const Eigen::SimplicialLDLT<Sparse> factorised(normal);
  const Eigen::MatrixXd follow = factorised.solve(Eigen::MatrixXd(nuisance.transpose() * extrinsics));

  ExtrinsicsInformation result;
  const Eigen::MatrixXd net = extrinsics - nuisance * follow;  // each residual's change by the extrinsics, all told
  const Eigen::Matrix<double, 7, 7> information = net.transpose() * net;
  result.information = 0.5 * (information + information.transpose());
  result.gradients.assign(poses, Vector7d::Zero());
  for (Eigen::Index row = 0; row < net.rows(); ++row)
    result.gradients[pose_of_row[static_cast<std::size_t>(row)]] +=
        residuals[static_cast<std::size_t>(row)] * net.row(row).transpose();
  return result;
}
}  // namespace scanloom
