#include "commands/set_options.h"

namespace understudy::commands {

CLI::Option* AddShortOption(CLI::App* app, SetArguments* arguments, const std::string& option,
                            const std::string& key, const std::string& type,
                            const std::string& help) {
  return app
      ->add_option_function<std::string>(
          option,
          [arguments, option, key](const std::string& value) {
            const std::string set = key + "=" + value;
            arguments->sets.insert(arguments->sets.begin(), set);
            arguments->typed[set] = option + " " + value;
          },
          help)
      ->type_name(type);
}

void AddProfileOption(CLI::App* app, SetArguments* arguments) {
  AddShortOption(app, arguments, "--profile", "profile", "NAME",
                 "How good the sensors are: ideal, nominal, worn or harsh [nominal]");
}

void AddSetOption(CLI::App* app, SetArguments* arguments, const std::string& what) {
  app->add_option_function<std::vector<std::string>>(
         "--set",
         [arguments](const std::vector<std::string>& sets) {
           arguments->sets.insert(arguments->sets.end(), sets.begin(), sets.end());
         },
         "Sets " + what + "; may be repeated")
      ->type_name("KEY=VALUE")
      ->take_all()
      ->allow_extra_args(false);
}

void AddSetOptions(CLI::App* app, SetArguments* arguments, const std::string& config_help,
                   const std::string& example) {
  app->add_option("--config", arguments->config_files, config_help + "; may be repeated")
      ->type_name("FILE")
      ->take_all()
      ->allow_extra_args(false);  // else it swallows the -- before a command
  AddSetOption(app, arguments, "one key, e.g. --set " + example);
}

}  // namespace understudy::commands
