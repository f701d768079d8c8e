/** `scanloom evaluate`: a trajectory against the true one. */
#include "Arguments.h"
#include "Verb.h"
#include "evaluation/PositionError.h"
#include "output/SecondsText.h"
#include "output/Trajectory.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <iostream>
#include <memory>

namespace scanloom
{
namespace
{
struct EvaluateArguments
{
  std::filesystem::path trajectory;
  std::filesystem::path reference;
  std::string align = "first";
  bool json = false;
};

std::string jsonOf(const PositionError& error)
{
  return nlohmann::json{{"poses", error.poses},
                        {"largest_m", error.largest},
                        {"largest_at_s", secondsText(error.largest_at)},
                        {"rmse_m", error.root_mean_square},
                        {"final_m", error.final},
                        {"path_length_m", error.path_length}}
      .dump(2);
}

std::string textOf(const PositionError& error)
{
  return fmt::format(
      "largest position error  {:.3f} m at {} s\nroot mean square        {:.3f} m\nat the end              {:.3f} m\n"
      "compared                {} poses over {:.2f} m",
      error.largest, secondsText(error.largest_at), error.root_mean_square, error.final, error.poses,
      error.path_length);
}

int run(const EvaluateArguments& arguments)
{
  const PositionError error = positionErrorFromFirstPose(readTum(arguments.trajectory), readTum(arguments.reference));
  std::cout << (arguments.json ? jsonOf(error) : textOf(error)) << '\n';
  return kDone;
}
}  // namespace

Verb evaluateVerb()
{
  return {"evaluate",
          "position error of a trajectory against a reference",
          {},
          [](CLI::App& app)
          {
            auto arguments = std::make_shared<EvaluateArguments>();
            app.add_option("--trajectory", arguments->trajectory, "the estimate, TUM")->required()->type_name("FILE");
            app.add_option("--reference", arguments->reference, "the truth, TUM")->required()->type_name("FILE");
            app.add_option("--align", arguments->align, "how the reference is moved onto the estimate")
                ->check(CLI::IsMember({"first"}))
                ->capture_default_str();
            addJson(app, arguments->json);
            return [arguments] { return run(*arguments); };
          }};
}
}  // namespace scanloom
