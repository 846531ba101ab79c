"""What serves all commands: streams that end no command, what is shown, what may be imported, mistakes, Ctrl-C."""
