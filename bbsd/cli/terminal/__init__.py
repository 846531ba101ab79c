"""What serves all commands: streams that end no command, what is shown, mistakes, Ctrl-C."""
