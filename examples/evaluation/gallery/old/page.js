// A click on a column's head sorts the table by it, another click the other way round.
for (const head of document.querySelectorAll("th")) {
    head.addEventListener("click", () => {
        const column = [...head.parentNode.children].indexOf(head);
        const body = head.closest("table").tBodies[0];
        const sign = head.dataset.sign === "1" ? -1 : 1;
        head.dataset.sign = sign;
        const key = (row) => row.children[column].dataset.key;
        body.append(...[...body.rows].sort((a, b) =>
            sign * (isNaN(key(a)) || isNaN(key(b)) ? key(a).localeCompare(key(b)) : key(a) - key(b))));
    });
}
// A choice shows its picture.
for (const choice of document.querySelectorAll("select")) {
    const show = () => { choice.parentNode.querySelector("img").src = choice.value; };
    choice.addEventListener("change", show);
    show();
}
