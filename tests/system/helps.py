"""The verbs of understudy, and the examples at the end of their helps."""

import re

from robots import understudy


def commands():
    return understudy("complete", "--", "").stdout.split()


def verbs():
    """Every subcommand, those of groups too."""
    def below(*path):
        children = understudy("complete", "--", *path, "").stdout.split() if path[0] == "ctl" and len(path) < 3 else []
        children = [child for child in children if understudy("ctl", *path[1:], child, "--help").returncode == 0]
        return [path] + [verb for child in children for verb in below(*path, child)]

    return [verb for command in commands() for verb in below(command)]


def examples_of(*verb):
    """The lines, without what they say about themselves: two spaces away, behind `#` or a semicolon."""
    text = understudy(*verb, "--help").stdout
    lines = re.findall(r"(?:^Example: |^  )([^:`\n]*understudy .*)$", text[text.find("\nExample"):], re.MULTILINE)
    return [re.split(r"\s{2,}| # |; `", line)[0].strip() for line in lines]
