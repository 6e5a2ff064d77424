// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// cslf verify: what a light field's file says about its quality, and whether it is true.
#include "Console/cslfHelp.h"
#include "Console/cslfMessages.h"
#include "Console/cslfNumberChecks.h"
#include "Fields/cslfFieldFiles.h"
#include "Scenes/cslfSceneFiles.h"
#include "cslfCertificate.h"
#include "cslfCommands.h"

#include "vtkCSLFEnvironment.h"
#include "vtkCSLFFieldCertifier.h"

#include <vtkAlgorithm.h>
#include <vtkNew.h>

#include <CLI/CLI.hpp>

#include <memory>
#include <optional>

namespace cslf::tool
{
namespace
{
struct Options
{
  FieldInput Field;
  SceneOptions Scene;
  std::optional<int> Rays;
  std::optional<int> Samples;
  std::optional<int> Seed;
};

/// Chooses the rays of the certificate, if there is one, unless the command line chooses others.
void ChooseRays(const Options& options, const std::optional<Certificate>& certificate,
  vtkCSLFFieldCertifier* certifier)
{
  if (certificate)
  {
    certifier->SetRays(certificate->Rays);
    certifier->SetRaySamples(certificate->Samples);
    certifier->SetSeed(certificate->Seed);
  }
  certifier->SetRays(options.Rays.value_or(certifier->GetRays()));
  certifier->SetRaySamples(options.Samples.value_or(certifier->GetRaySamples()));
  certifier->SetSeed(options.Seed.value_or(certifier->GetSeed()));
}

/// Compares the field with the scene.
Certificate Measure(Options options, const FieldFile& file)
{
  options.Scene.TakeDefaults(nlohmann::json::parse(file.Field.Sampling, nullptr, false));
  const Scene scene = options.Scene.Read();
  vtkNew<vtkCSLFFieldCertifier> certifier;
  options.Scene.Apply(scene, certifier);
  certifier->GetEnvironment()->SetShow(file.Field.MayShowEnvironment());
  certifier->SetInputConnection(1, file.Reader->GetOutputPort());
  if (vtkAlgorithmOutput* geometry = file.GetGeometry())
  {
    certifier->SetInputConnection(2, geometry);
  }
  ChooseRays(options, file.Field.Measured, certifier);
  {
    const ProgressBar bar(certifier, "Comparing with the scene");
    certifier->Measure();
  }
  ThrowOnError();
  const auto measured =
    Certificate::FromJSON(nlohmann::json::parse(certifier->GetCertificate(), nullptr, false));
  if (!measured)
  {
    throw Failure("The field cannot be compared with the scene.");
  }
  return *measured;
}

Result Run(const Options& options)
{
  const FieldFile file = OpenField(options.Field);
  const std::string& name = options.Field.FileName;
  const std::optional<Certificate>& certificate = file.Field.Measured;
  if (!certificate && options.Scene.IsEmpty())
  {
    throw Failure(name + " has no certificate.");
  }
  Result result;
  result.JSON = { { "field", name } };
  if (certificate)
  {
    result.JSON["certificate"] = certificate->ToJSON();
    result.Text = name + ": " + certificate->Describe() + "\n";
  }
  if (options.Scene.IsEmpty())
  {
    return result;
  }
  const Certificate measured = Measure(options, file);
  if (!certificate)
  {
    throw Failure(name + " has no certificate to compare with. Measured: " + measured.Describe());
  }
  const std::string worse = certificate->FindWorse(measured);
  if (!worse.empty())
  {
    throw Failure(name + " is not as good as it was: " + worse + ".");
  }
  result.JSON["measured"] = measured.ToJSON();
  result.Text += "measured: " + measured.Describe() + "\nThe field is as good as it says.\n";
  return result;
}

/// An option for a positive number whose default is that of the certificate.
void AddNumber(CLI::App& command, const std::string& flag, std::optional<int>& value, int least,
  const char* help)
{
  command.add_option(flag, value, std::string(help) + " (default: that of the certificate)")
    ->check(Between(least, 1000000))
    ->type_name("NUMBER");
}
}

void AddVerify(CLI::App& app, Command& chosen)
{
  CLI::App* command = app.add_subcommand(
    "verify", "Print the certificate of a light field's file, or measure the field again");
  command->footer(MakeFooter({ "cslf verify box.mp4", "cslf verify box.mp4 cornell-box" },
    "A certificate says how well a file shows the scene that it was sampled from, as measured when "
    "the file was finished: the PSNR of random pixels of cameras around the cube against path "
    "tracing, the root mean square and the mean of the differences as fractions of white, the "
    "number of pixels (rays) and of samples of each, the seed, the version of CSLF and the hash of "
    "the scene. With a scene, the same rays are traced and compared again, or others if --rays, "
    "--samples or --seed say so. It is an error if the hash of the scene differs, if the field has "
    "no certificate, or if it is clearly worse than its certificate says: by at least 1 dB, and by "
    "more than four standard errors of the difference, or one standard error for the same rays. "
    "Specify the material and light that the field was sampled with."));
  const auto options = std::make_shared<Options>();
  options->Field.AddTo(*command);
  options->Scene.AddOptionalTo(*command);
  AddNumber(*command, "--rays", options->Rays, 2, "number of rays");
  AddNumber(*command, "--samples", options->Samples, 1,
    "samples of each ray, rounded up to a multiple of 64");
  AddNumber(*command, "--seed", options->Seed, 0, "random seed of the rays and their paths");
  command->callback([options, &chosen] { chosen = [options] { return Run(*options); }; });
}
}
