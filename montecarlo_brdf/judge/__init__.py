"""From a claim to a finding: decided at its error level, or open in the end."""
