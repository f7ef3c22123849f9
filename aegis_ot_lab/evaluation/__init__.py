"""Both layers scored on labelled data, and the paper's results measured again."""
